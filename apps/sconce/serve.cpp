// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/scratch_folder.h"
#include "web/server.h"
#include "web_site.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// The page looks for a server where it is told to.
void mark_live(const fs::path& index, bool writes) {
  constexpr std::string_view kOff = "name=\"sconce-live\" content=\"";
  std::string text = read_file(index);
  const std::size_t at = text.find(kOff);
  if (at == std::string::npos)
    throw Error(index.string(), "is not the page of this version: 'make web' builds it");
  write_file(index, text.insert(at + kOff.size(), writes ? "write" : "read"));
}

}  // namespace

int run_serve(int argc, const char* const* argv) {
  std::string input;
  web::ServerParams params;
  WebOptions web;
  Options options(
      "serve",
      "The page of 'export --web' from this machine, with faders that all its windows, and scripts by "
      "PUT /mix, share. Ctrl-C ends it.",
      {"sconce serve kitchen.sconce", "sconce serve kitchen.sconce --port 9000 --allow-write",
       "sconce export {PACKAGE} --web site"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  options.option("--port", &params.port, "0 = any free one");
  options.option("--host", &params.host, "address to listen on; 0.0.0.0 = for every machine around");
  options.flag("--allow-write", &params.allow_write, "windows and scripts may move the shared faders");
  web.declare(options);
  if (const auto code = options.parse(argc, argv)) return *code;
  if (params.port < 0 || params.port > 65535)
    throw UsageError("--port", fmt::format("{} is out of range", params.port), "0 to 65535");
  web.check();

  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  const ScratchFolder folder;
  write_web_site(input, folder.path(), web, progress);
  mark_live(folder.path() / "index.html", params.allow_write);
  params.folder = folder.path();
  web::Server server(web::SharedMix(Package::open(input).manifest().groups), params);
  if (options.json)
    fmt::print("{{\"url\": \"http://{}:{}/\"}}\n", params.host, server.port());
  else if (!options.quiet)
    fmt::print("http://{}:{}/ shows {}{}; Ctrl-C ends it\n", params.host, server.port(), input,
               params.allow_write ? "" : ", read-only");
  options.next({input});
  std::fflush(stdout);
  server.run(progress.stop);
  return kDone;
}

}  // namespace sconce::app

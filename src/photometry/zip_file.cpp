// SPDX-License-Identifier: Apache-2.0
// The only place that names libzip.
#include "photometry/zip_file.h"

#include <zip.h>

#include <fstream>

#include "core/error.h"

namespace sconce {

namespace {

constexpr zip_uint64_t kMostBytes = 64 << 20;  // of a file inside; more is a bomb

}  // namespace

void ZipFile::Close::operator()(zip* opened) const {
  ::zip_discard(opened);
}

ZipFile::ZipFile(const std::filesystem::path& path, const std::string& kind) : where_(path.string()) {
  int code = 0;
  zip_.reset(::zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (zip_) return;
  if (code == ZIP_ER_NOZIP) {
    std::string begin(2, '\0');
    std::ifstream(path, std::ios::binary).read(begin.data(), 2);
    if (begin == "PK") throw Error(where_, "is a zip that is cut short or damaged");
    throw NotMyFormat(where_, "is no " + kind + " container");
  }
  zip_error_t error;
  ::zip_error_init_with_code(&error, code);
  const std::string what = ::zip_error_strerror(&error);
  ::zip_error_fini(&error);
  throw Error(where_, "cannot be opened: " + what);
}

std::string ZipFile::read(const std::string& name) const {
  zip_stat_t stat{};
  if (::zip_stat(zip_.get(), name.c_str(), ZIP_FL_NOCASE, &stat) != 0)
    throw Error(where_, "holds no file '" + name + "'");
  if (stat.size > kMostBytes) throw Error(where_, "holds '" + name + "' of more than 64 MB");
  const std::unique_ptr<zip_file_t, decltype(&::zip_fclose)> file(
      ::zip_fopen_index(zip_.get(), stat.index, 0), &::zip_fclose);
  std::string out(stat.size, '\0');
  if (!file || ::zip_fread(file.get(), out.data(), stat.size) != static_cast<zip_int64_t>(stat.size))
    throw Error(where_, "is damaged at '" + name + "'");
  return out;
}

std::vector<std::string> ZipFile::names() const {
  std::vector<std::string> out;
  for (zip_int64_t i = 0; i < ::zip_get_num_entries(zip_.get(), 0); ++i)
    if (const char* name = ::zip_get_name(zip_.get(), static_cast<zip_uint64_t>(i), 0);
        name != nullptr && *name != '\0' && !std::string_view(name).ends_with('/'))
      out.emplace_back(name);
  return out;
}

}  // namespace sconce

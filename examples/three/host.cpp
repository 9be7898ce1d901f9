// SPDX-License-Identifier: Apache-2.0
// The other half of the three.js example: it serves the page, the room and sconce to this machine's browser.
// With OUT, a prefix of files, the page posts pictures without and with bounces, before and after its shaders
// changed, and then ends the program; without, it shows the room until Ctrl-C.
#include <httplib.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "room/report.h"
#include "web/radiosity_service.h"

using Json = nlohmann::json;

namespace {

Json room_as_json(bool shiny) {
  Json paints = Json::array(), walls = Json::array();
  for (const room::Paint& p : room::kPaints)
    paints.push_back({{"name", p.name}, {"color", p.color}, {"emission", p.emission}});
  for (const room::Wall& w : room::walls())
    walls.push_back({{"paint", w.paint}, {"corner", w.corner}, {"a", w.a}, {"b", w.b}});
  const room::Lamp lamp;
  return {{"paints", paints},
          {"walls", walls},
          {"shine", shiny ? 0.3 : 0.0},
          {"eye", room::kEye},
          {"target", room::kTarget},
          {"fov", room::kFieldOfView},
          {"width", room::kWidth},
          {"height", room::kHeight},
          {"lamp", lamp.position},
          {"strength", lamp.strength},
          {"repainted", room::kRepainted},
          {"new_color", room::kNewColor}};
}

int run(const std::string& out, bool shiny) {
  sconce::web::RadiosityListener listener;
  if (!out.empty()) {
    listener.found = [](const sconce::Detection& found) { room::print(found); };
    listener.frame = [](const sconce::FrameReport& frame) { room::print(frame); };
  }
  sconce::web::RadiosityService service(listener);
  httplib::Server server;
  server.set_tcp_nodelay(true);
  if (!server.set_mount_point("/three/", THREE_BUILD))
    throw sconce::Error(THREE_BUILD, "is not there", "three.js from npm: 'make web' brings it");
  server.set_mount_point("/", THREE_PAGE);
  service.add_to(server);
  server.Get("/room.json", [&](const httplib::Request&, httplib::Response& response) {
    response.set_content(room_as_json(shiny).dump(), "application/json");
  });
  if (!out.empty()) {
    server.Post("/picture", [&](const httplib::Request& request, httplib::Response& response) {
      if (request.body.size() != sizeof(float) * 4 * room::kWidth * room::kHeight) {
        response.status = 400;
        return;
      }
      room::write(out + "-" + request.get_param_value("name"),
                  reinterpret_cast<const float*>(request.body.data()), true);
    });
    server.Post("/done", [&](const httplib::Request&, httplib::Response&) { server.stop(); });
  }
  const int port = server.bind_to_any_port("127.0.0.1");
  if (port < 0) throw sconce::Error({}, "there is no free port");
  fmt::print("http://127.0.0.1:{}/{}\n", port, out.empty() ? "" : "?pictures");
  std::fflush(stdout);
  server.listen_after_bind();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? argv[1] : "", argc > 2 && std::string(argv[2]) == "--shiny");
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}

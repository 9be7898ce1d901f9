// SPDX-License-Identifier: Apache-2.0
#include "web/radiosity_service.h"

#include <httplib.h>

#include <thread>

#include "core/error.h"
#include "detect/ambient_map.h"
#include "shader/vertex_override.h"
#include "web/radiosity_message.h"
#include "web/turns.h"

namespace sconce::web {

using Json = nlohmann::json;

namespace {

Json json_of(const Rgb& c) {
  return {c.r, c.g, c.b};
}
Json json_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

std::vector<float> flat(const PartCorners& parts) {
  std::vector<float> floats;
  for (const std::vector<Vec2>& part : parts)
    for (const Vec2& at : part) floats.insert(floats.end(), {at.x, at.y});
  return floats;
}

/// Positions of all meshes' vertices, three per face, then as many normals.
Scene scene_of(const RadiosityMessage& message) {
  Scene scene;
  for (const Json& name : message.head.at("materials")) scene.materials.emplace_back().name = name;
  const std::size_t all = message.floats.size() / 2;
  const float* next = message.floats.data();
  for (const Json& mesh : message.head.at("meshes")) {
    const auto size = mesh.at("vertices").get<std::size_t>(),
               material = mesh.at("material").get<std::size_t>();
    const auto left = static_cast<std::size_t>(message.floats.data() + all - next);
    if (size > left / 3 || size % 3 != 0 || material >= scene.materials.size())
      throw Error("geometry", "has fewer vertices or materials than its meshes, or no three to a face");
    const auto vectors = [size](const float* from) {
      std::vector<Vec3> v;
      for (std::size_t i = 0; i < size; ++i) v.emplace_back(from[3 * i], from[3 * i + 1], from[3 * i + 2]);
      return v;
    };
    add_part(scene, Id<Material>(material), vectors(next), vectors(next + all));
    next += 3 * size;
  }
  if (scene.meshes.empty()) throw Error("geometry", "has no meshes");
  return scene;
}

}  // namespace

/// One page: its map, and the thread that asks the page to draw.
class RadiosityService::Session {
 public:
  Session(const RadiosityMessage& geometry, const RadiosityListener& listener)
      : listener_(listener), map_(scene_of(geometry), geometry.head.at("density")) {}
  ~Session() { end(); }
  /// Whoever waits for the other side goes on.
  void end() { turns_.end(); }

  RadiosityMessage coordinates() const {
    return {{{"width", map_.space().width}, {"height", map_.space().height}}, flat(map_.coordinates())};
  }
  void start() {
    solver_ = std::jthread([this](std::stop_token stop) {
      try {
        solve(std::move(stop));
      } catch (const Turns::Ended&) {
      } catch (const std::exception& e) {
        failure_ = e.what();
        end();
      }
    });
  }
  std::string turn(std::string answer) {
    try {
      return turns_.ask_solver(std::move(answer));
    } catch (const Turns::Ended&) {
      return RadiosityMessage{{{"kind", "failed"}, {"message", failure_}}, {}}.text();
    }
  }

 private:
  void solve(std::stop_token stop) {
    turns_.wait_for_page();
    map_.start({[this](const DrawRequest& request) { return draw(request); }}, quick_transfer(),
               {{}, {}, stop});
    std::string wanted = turns_.ask_page(found().text());
    for (;;)
      wanted = turns_.ask_page(
          (RadiosityMessage::read(wanted).head.at("kind") == "detect" ? found_again(stop) : frame()).text());
  }

  RadiosityMessage found_again(std::stop_token stop) {
    try {
      map_.detect({{}, {}, std::move(stop)});
    } catch (const Error& e) {
      return {{{"kind", "failed"}, {"message", e.what()}}, {}};
    }
    return found();
  }

  RadiosityMessage found() const {
    const Detection& found = map_.detection();
    if (listener_.found) listener_.found(found);
    Json materials = Json::array();
    for (const DetectedMaterial& m : found.materials)
      materials.push_back({{"reflectance", json_of(m.response.reflectance)},
                           {"emission", json_of(m.response.emission)},
                           {"transmission", json_of(m.response.transmission)},
                           {"residual", m.residual}});
    return {{{"kind", "found"}, {"materials", materials}, {"findings", found.findings}}, {}};
  }

  RadiosityMessage frame() {
    const FrameReport report = map_.update();
    if (listener_.frame) listener_.frame(report);
    RadiosityMessage message{{{"kind", "frame"},
                              {"fault", report.fault},
                              {"drawn", report.capture.milliseconds},
                              {"read", report.capture.read_milliseconds},
                              {"solved", report.solve_milliseconds}},
                             {}};
    for (const Rgb& c : map_.texels()) message.floats.insert(message.floats.end(), {c.r, c.g, c.b, 1});
    return message;
  }

  Drawing draw(const DrawRequest& request) {
    static constexpr std::array kLights{"none", "probe", "all"};
    RadiosityMessage question{{{"kind", "draw"},
                               {"lights", kLights[static_cast<std::size_t>(request.lights)]},
                               {"to_light", json_of(request.probe.to_light)},
                               {"intensity", request.probe.intensity},
                               {"eye", json_of(request.eye)},
                               {"white_card", request.white_card},
                               {"background", request.background},
                               {"width", request.width},
                               {"height", request.height}},
                              flat(map_.places(request))};
    if (question.floats == places_)
      question.floats.clear();  // the page has them
    else
      places_ = question.floats;
    const RadiosityMessage answer = RadiosityMessage::read(turns_.ask_page(question.text()));
    if (const std::string fault = answer.head.value("fault", ""); !fault.empty())
      throw std::runtime_error(fault);
    Drawing drawing{answer.head.at("width"), answer.head.at("height"), {}, {}, answer.head.at("read")};
    for (std::size_t i = 0; i + 3 < answer.floats.size(); i += 4)
      drawing.values.insert(drawing.values.end(), &answer.floats[i], &answer.floats[i + 3]);
    return drawing;
  }

  const RadiosityListener& listener_;
  AmbientMap map_;
  std::vector<float> places_;  ///< that the page was sent last
  Turns turns_;
  std::string failure_ = "another page has begun";
  std::jthread solver_;
};

RadiosityService::RadiosityService(RadiosityListener listener) : listener_(std::move(listener)) {}
RadiosityService::~RadiosityService() = default;

void RadiosityService::add_to(httplib::Server& server) {
  const auto post = [&server](const char* path,
                              const std::function<std::string(const httplib::Request&)>& f) {
    server.Post(path, [f](const httplib::Request& request, httplib::Response& response) {
      try {
        response.set_content(f(request), "application/octet-stream");
      } catch (const std::exception& e) {
        response.status = 422;
        response.set_content(e.what(), "text/plain");
      }
    });
  };
  post("/sconce/override", [](const httplib::Request& request) {
    return override_vertex_position(request.body, request.get_param_value("name"));
  });
  post("/sconce/start", [this](const httplib::Request& request) {
    const auto session = std::make_shared<Session>(RadiosityMessage::read(request.body), listener_);
    const std::lock_guard lock(mutex_);
    if (session_) session_->end();
    session_ = session;
    session->start();
    return session->coordinates().text();
  });
  post("/sconce/turn", [this](const httplib::Request& request) {
    std::unique_lock lock(mutex_);
    const auto session = session_;
    lock.unlock();
    if (!session) throw Error("turn", "nothing was started");
    return session->turn(request.body);
  });
}

}  // namespace sconce::web

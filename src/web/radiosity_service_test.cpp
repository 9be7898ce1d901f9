// SPDX-License-Identifier: Apache-2.0
// A furnace whose renderer answers over a socket, as a page does: walls that shine as 1 and reflect a half
// see 2 from everywhere.
#include "web/radiosity_service.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <thread>

#include "detect/ambient_map.h"
#include "detect/synthetic_host.h"
#include "scene/shapes.h"
#include "web/radiosity_message.h"

namespace sconce::web {
namespace {

using Message = RadiosityMessage;

class RadiosityServiceTest : public testing::Test {
 protected:
  void SetUp() override {
    service_.add_to(server_);
    const int port = server_.bind_to_any_port("127.0.0.1");
    ASSERT_GT(port, 0);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    client_ = std::make_unique<httplib::Client>("127.0.0.1", port);
    client_->set_read_timeout(60);
  }
  void TearDown() override {
    while (!server_.is_running()) std::this_thread::yield();
    server_.stop();
    thread_.join();
  }

  httplib::Result post(const std::string& what, const std::string& body) {
    return client_->Post("/sconce/" + what, body, "application/octet-stream");
  }
  Message turn(const Message& message) { return Message::read(post("turn", message.text())->body); }

  /// Three vertices to a face, as their renderer has them.
  static Message geometry(const World& world, std::size_t vertices) {
    Message message{
        {{"materials", {"grey"}}, {"meshes", {{{"vertices", vertices}, {"material", 0}}}}, {"density", 8}},
        {}};
    const auto add = [&](const Vec3& v) { message.floats.insert(message.floats.end(), {v.x, v.y, v.z}); };
    for (uint32_t t = 0; t < world.size(); ++t)
      for (const uint32_t v : world.triangles[t].v) add(world.positions[v]);
    for (uint32_t t = 0; t < world.size(); ++t)
      for (int c = 0; c < 3; ++c) add(world.face_normals[t]);
    return message;
  }

  /// Draws until there is an answer. @param spoil  the drawing
  Message answered(const std::string& kind, SyntheticHost& host,
                   const std::function<void(Message&)>& spoil = {}) {
    Message reply = turn({{{"kind", kind}}, {}});
    while (reply.head.at("kind") == "draw") {
      if (!reply.floats.empty()) places_ = reply.floats;
      Message drawn = draw(reply.head, host);
      if (spoil) spoil(drawn);
      reply = turn(drawn);
    }
    return reply;
  }

  Message draw(const nlohmann::json& asked, SyntheticHost& host) const {
    const auto vec = [](const nlohmann::json& v) { return Vec3(v[0], v[1], v[2]); };
    DrawRequest request;
    request.width = asked.at("width"), request.height = asked.at("height");
    request.lights = asked.at("lights") == "none"    ? DrawRequest::Lights::none
                     : asked.at("lights") == "probe" ? DrawRequest::Lights::probe
                                                     : DrawRequest::Lights::all;
    request.probe = {vec(asked.at("to_light")), asked.at("intensity")};
    request.eye = vec(asked.at("eye"));
    request.white_card = asked.at("white_card"), request.background = asked.at("background");
    std::vector<uint32_t> triangles;
    std::vector<std::array<Vec2, 3>> corners;
    for (std::size_t v = 0; 2 * v + 5 < places_.size(); v += 3) {
      if (places_[2 * v] > 1) continue;  // not this time
      triangles.push_back(static_cast<uint32_t>(v / 3));
      for (std::array<Vec2, 3>& at = corners.emplace_back(); Vec2 & corner : at)
        corner = Vec2(places_[2 * (v + static_cast<std::size_t>(&corner - at.data()))],
                      places_[2 * (v + static_cast<std::size_t>(&corner - at.data())) + 1]) *
                 Vec2(request.width, request.height);
    }
    request.triangles = triangles, request.corners = corners;
    Message message{{{"kind", "drawn"}, {"width", request.width}, {"height", request.height}, {"read", 0.5}},
                    {}};
    const std::vector<float> rgb = host.draw(request).values;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
      message.floats.insert(message.floats.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 1});
    return message;
  }

  RadiosityService service_;
  httplib::Server server_;
  std::thread thread_;
  std::unique_ptr<httplib::Client> client_;
  std::vector<float> places_;
};

TEST_F(RadiosityServiceTest, Furnace) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.2f)), Vec3(0), Vec3(1), true);
  const World world = make_world(scene);
  SyntheticHost host{world, {{{Rgb(1), Rgb(), Rgb(0.5f)}}}};
  const auto started = post("start", geometry(world, 3 * world.size()).text());
  ASSERT_EQ(started->status, 200) << started->body;
  const Message map = Message::read(started->body);
  EXPECT_EQ(map.floats.size(), 6 * world.size());

  const Message found = answered("begin", host);
  ASSERT_EQ(found.head.at("kind"), "found") << found.head;
  EXPECT_NEAR(found.head.at("materials")[0].at("reflectance")[1].get<float>(), 0.5f, 1e-3f);
  const auto brightest = [&](const Message& frame) {
    float most = 0;
    for (std::size_t i = 0; i < frame.floats.size(); i += 4) most = std::max(most, frame.floats[i]);
    return most;
  };
  Message frame = answered("update", host);
  ASSERT_EQ(frame.head.at("kind"), "frame") << frame.head;
  EXPECT_EQ(frame.head.at("fault"), "");
  EXPECT_EQ(frame.head.at("read"), 0.5);
  EXPECT_EQ(frame.floats.size(),
            4 * map.head.at("width").get<std::size_t>() * map.head.at("height").get<std::size_t>());
  EXPECT_NEAR(brightest(frame), 2, 0.06f);
  // One drawing goes wrong, and the next is right again.
  frame = answered("update", host, [](Message& drawn) { drawn.floats.resize(drawn.floats.size() - 4); });
  EXPECT_NE(frame.head.at("fault"), "");
  EXPECT_EQ(brightest(frame), 0);
  frame = answered("update", host, [](Message& drawn) { drawn = {{{"fault", "the context is lost"}}, {}}; });
  EXPECT_NE(frame.head.at("fault").get<std::string>().find("the context is lost"), std::string::npos);
  EXPECT_NEAR(brightest(answered("update", host)), 2, 0.06f);
}

TEST_F(RadiosityServiceTest, RefusesInOneLine) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.2f)), Vec3(0), Vec3(1), true);
  const World world = make_world(scene);
  const std::string whole = geometry(world, 3 * world.size()).text();
  for (const std::string& bad :
       {std::string(), std::string("\xff\xff\xff\xff"), whole.substr(0, 20), std::string("\4\0\0\0null", 8),
        std::string("\4\0\0\0{}  ", 8), geometry(world, 3 * world.size() + 3).text(),
        geometry(world, static_cast<std::size_t>(-1) / 3).text(), geometry(world, 4).text()}) {
    const auto answer = post("start", bad);
    EXPECT_EQ(answer->status, 422) << bad.substr(0, 40);
    EXPECT_FALSE(answer->body.empty());
    EXPECT_EQ(answer->body.find('\n'), std::string::npos) << answer->body;
  }
  EXPECT_EQ(post("turn", Message{{{"kind", "update"}}, {}}.text())->status, 422) << "nothing was started";
  EXPECT_EQ(post("override?name=a.vert", "#version 330\nvoid frag() {}\n")->status, 422);
  const auto shader = post("override?name=a.vert", "#version 330\nvoid main() { gl_Position = vec4(0); }\n");
  EXPECT_EQ(shader->status, 200) << shader->body;
  EXPECT_NE(shader->body.find("sconce_place"), std::string::npos);
}

}  // namespace
}  // namespace sconce::web

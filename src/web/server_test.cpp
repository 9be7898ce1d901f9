// SPDX-License-Identifier: Apache-2.0
// Over real sockets: what is served, what is not, and what people do to servers.
#include "web/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "core/test_folder.h"
#include "package/test_package.h"

namespace sconce::web {
namespace {

using Json = nlohmann::json;

class Socket {
 public:
  explicit Socket(int port) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~Socket() { ::close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void send(const std::string& text) const { ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL); }
  /// Until `end` was seen, or all.
  std::string receive(const std::string& end = "") const {
    std::string text;
    char part[4096];
    while (end.empty() || text.find(end) == std::string::npos) {
      const ssize_t n = ::recv(fd_, part, sizeof part, 0);
      if (n <= 0) break;
      text.append(part, static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  int fd_;
};

class Served : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "site");
    folder_.write("site/index.html", "the page");
    folder_.write("secret", "not for you");
    start(false);
  }
  void start(bool writes) {
    thread_ = {};
    ServerParams params;
    params.folder = folder_ / "site";
    params.port = 0;
    params.allow_write = writes;
    server_ = std::make_unique<Server>(SharedMix(test_package(2, 1, 4, 4).manifest.groups), params);
    thread_ = std::jthread([this](std::stop_token stop) { server_->run(stop); });
  }
  std::string ask(const std::string& method, const std::string& path, const std::string& body = "",
                  const std::string& host = "localhost") const {
    const Socket socket(server_->port());
    socket.send(method + " " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" +
                (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" +
                body);
    return socket.receive();
  }
  static int status(const std::string& answer) { return std::stoi(answer.substr(9, 3)); }
  static Json content(const std::string& answer) {
    return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  }

  TemporaryFolder folder_;
  std::unique_ptr<Server> server_;
  std::jthread thread_;
};

TEST_F(Served, FilesAndNothingElse) {
  EXPECT_NE(ask("GET", "/").find("the page"), std::string::npos);
  EXPECT_EQ(status(ask("GET", "/missing.js")), 404);
  for (const char* path : {"/../secret", "/%2e%2e/secret", "/..%2fsecret", "/x/../../secret",
                           "/%2e%2e%2fsecret", "//../secret", "/..\\secret"}) {
    const std::string answer = ask("GET", path);
    EXPECT_EQ(answer.find("not for you"), std::string::npos) << path;
    EXPECT_GE(status(answer), 400) << path;
  }
}

TEST_F(Served, ReadOnlyUnlessAllowed) {
  EXPECT_EQ(content(ask("GET", "/mix"))["settings"]["a"], "on");
  EXPECT_EQ(status(ask("PUT", "/mix", R"({"settings": {"a": "off"}})")), 403);
  EXPECT_EQ(content(ask("GET", "/mix"))["settings"]["a"], "on");
}

TEST_F(Served, ScriptsMoveFaders) {
  start(true);
  const std::string answer =
      ask("PUT", "/mix", R"({"settings": {"a": "50%", "b": "+1ev"}, "tone": "drago", "ev100": "9"})");
  EXPECT_EQ(status(answer), 200);
  const Json mix = content(ask("GET", "/mix"));
  EXPECT_EQ(mix["weights"]["a"], Json({0.5, 0.5, 0.5}));
  EXPECT_EQ(mix["weights"]["b"], Json({2, 2, 2}));
  EXPECT_EQ(mix["tone"], "drago");
  EXPECT_EQ(mix["exposure"], "");
  // What was read may be sent back; what is left out stays.
  EXPECT_EQ(status(ask("PUT", "/mix", mix.dump())), 200);
  EXPECT_EQ(content(ask("PUT", "/mix", R"({"settings": {"b": "off"}, "exposure": "+1"})"))["settings"],
            Json({{"a", "50%"}, {"b", "off"}}));
}

TEST_F(Served, BadMixesAreToldAndChangeNothing) {
  start(true);
  for (const char* body :
       {"nonsense", "[1]", R"({"settings": {"c": "on"}})", R"({"settings": {"a": "blue"}})",
        R"({"settings": {"a": 1}})", R"({"tone": "x"})", R"({"exposure": "much"})", R"({"other": 1})",
        R"({"settings": {"b": "off"}, "tone": "x"})"}) {
    const std::string answer = ask("PUT", "/mix", body);
    EXPECT_EQ(status(answer), 400) << body;
    EXPECT_FALSE(content(answer)["error"].get<std::string>().empty());
  }
  EXPECT_EQ(content(ask("GET", "/mix"))["settings"], Json({{"a", "on"}, {"b", "on"}}));
}

TEST_F(Served, WindowsHearOfChanges) {
  start(true);
  const Socket window(server_->port());
  window.send("GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_NE(window.receive("\n\n").find("text/event-stream"), std::string::npos);
  ask("PUT", "/mix", R"({"settings": {"a": "25%"}, "from": "script"})");
  EXPECT_NE(window.receive("\"from\":\"script\"").find("25%"), std::string::npos);
}

TEST_F(Served, HugeRequestsAreRefused) {
  start(true);
  EXPECT_EQ(status(ask("PUT", "/mix", std::string(Server::kLargestRequest + 1, ' '))), 413);
  EXPECT_GE(status(ask("GET", "/" + std::string(20000, 'x'))), 400);
  EXPECT_EQ(status(ask("GET", "/mix")), 200);
}

// Forty who say half a sentence, and one who asks.
TEST_F(Served, SlowClientsDoNotBlockOthers) {
  std::vector<std::unique_ptr<Socket>> slow;
  for (int i = 0; i < 40; ++i) {
    slow.push_back(std::make_unique<Socket>(server_->port()));
    slow.back()->send("GET /mix HT");
  }
  EXPECT_EQ(status(ask("GET", "/mix")), 200);
  // They are let go after their time.
  EXPECT_EQ(slow.front()->receive().find("200"), std::string::npos);
}

TEST_F(Served, TooManyWindowsAreTold) {
  std::vector<std::unique_ptr<Socket>> windows;
  for (int i = 0; i < Server::kStreams; ++i) {
    windows.push_back(std::make_unique<Socket>(server_->port()));
    windows.back()->send("GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n");
    windows.back()->receive("\n\n");
  }
  EXPECT_EQ(status(ask("GET", "/events")), 503);
  EXPECT_EQ(status(ask("GET", "/mix")), 200);
}

// A page elsewhere whose name was made to point here.
TEST_F(Served, OtherHostsNamesAreRefused) {
  EXPECT_EQ(status(ask("GET", "/mix", "", "evil.example:80")), 403);
  EXPECT_EQ(status(ask("GET", "/mix", "", "127.0.0.1:8080")), 200);
}

TEST_F(Served, TakenPortIsTold) {
  ServerParams params;
  params.folder = folder_ / "site";
  params.port = server_->port();
  EXPECT_THROW(Server(SharedMix(test_package(1, 1, 4, 4).manifest.groups), params), Error);
}

}  // namespace
}  // namespace sconce::web

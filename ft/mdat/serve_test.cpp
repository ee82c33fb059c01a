// mdat serve as its user meets it: the address that it prints, what answers there, how it ends.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

struct Place {
  std::string port, token;
};

// Of "http://127.0.0.1:PORT/?token=T".
Place place_of(const std::string& address) {
  const std::size_t colon = address.rfind(':'), slash = address.find('/', colon), equals = address.find('=');
  if (slash == std::string::npos || equals == std::string::npos) return {};
  return {address.substr(colon + 1, slash - colon - 1), address.substr(equals + 1, 32)};
}

// The whole answer; empty where nothing listens.
std::string ask(const Place& place, const std::string& request_line, std::uint32_t host = INADDR_LOOPBACK) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.port)));
  address.sin_addr.s_addr = htonl(host);
  std::string answer;
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    const std::string request = request_line + " HTTP/1.1\r\nHost: localhost:" + place.port + "\r\nAuthorization: Bearer " + place.token +
                                "\r\nConnection: close\r\n\r\n";
    (void)::send(socket, request.data(), request.size(), MSG_NOSIGNAL);
    char part[4096];
    for (ssize_t size = 1; size > 0;) {
      size = ::recv(socket, part, sizeof part, 0);
      if (size > 0) answer.append(part, static_cast<std::size_t>(size));
    }
  }
  ::close(socket);
  return answer;
}

std::string waited_for(const std::function<std::string()>& look) {
  for (int i = 0; i < 600; ++i) {
    if (const std::string found = look(); !found.empty()) return found;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return "";
}

class Serve : public ::testing::Test {
 protected:
  Serve() : program_(work_, "serve . --port 0") {
    const std::string address = waited_for([&] {
      const std::string text = program_.printed();
      return text.find('\n') != std::string::npos ? text : "";
    });
    EXPECT_EQ(address.rfind("http://127.0.0.1:", 0), 0U) << address;
    place_ = place_of(address);
  }
  WorkFolder work_;
  Program program_;
  Place place_;
};

TEST_F(Serve, ListensOnTheLoopbackAddressAndEndsByCtrlC) {
  VERIFIES("LASSO-WEB-003~1 LASSO-WEB-016~1");
  EXPECT_NE(ask(place_, "GET /api/about").find("\"features\":[\"replay\",\"live\",\"design\"]"), std::string::npos);
  EXPECT_EQ(ask(place_, "GET /api/about", INADDR_LOOPBACK + 1), "");  // 127.0.0.2: another address of this machine
  const Answer answer = program_.interrupt();
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, "http://127.0.0.1:" + place_.port + "/?token=" + place_.token + "\n");
}

TEST_F(Serve, AnAddressInUseIsOneClearLine) {
  VERIFIES("LASSO-WEB-014~1");
  const Answer second = work_.mdat("serve . --port " + place_.port);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_EQ(second.err,
            "mdat: 127.0.0.1:" + place_.port + ": another program listens there: choose another port, or 0 for any that is free\n");
  const Answer none = work_.mdat("serve nowhere");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err, "mdat: nowhere: no such file or folder: expected a recording (.mcap), or a folder with some\n");
}

// A first visit: the recording is made, listed, and its frames can be asked for.
TEST_F(Serve, RecordsTheTenthScaleHubbleOnRequest) {
  VERIFIES("LASSO-WEB-017~1");
  const std::string begun = ask(place_, "POST /api/recordings/first");
  EXPECT_NE(begun.find("\"job\":\"job1\""), std::string::npos) << begun;
  const std::string job = waited_for([&] {
    const std::string answer = ask(place_, "GET /api/jobs/job1");
    return answer.find("\"id\":") != std::string::npos || answer.find("\"error\":") != std::string::npos ? answer : "";
  });
  const std::size_t at = job.find("\"id\":\"");
  ASSERT_NE(at, std::string::npos) << job;
  const std::string id = job.substr(at + 6, 16);
  EXPECT_NE(ask(place_, "GET /api/recordings").find(id), std::string::npos);
  EXPECT_NE(ask(place_, "GET /api/recordings/" + id).find("\"frames\":360,"), std::string::npos);
  EXPECT_NE(ask(place_, "GET /api/recordings/" + id + "/frames/200").find("\"mode\":\"tracking\",\"valid\":true,\"wrong\":false"),
            std::string::npos);
  EXPECT_NE(ask(place_, "POST /api/recordings/first").find("{\"id\":\"" + id + "\"}"), std::string::npos);
}

}  // namespace
}  // namespace lasso::ft

// The server over real sockets of the loopback address, on a port that the system chose.
#include "mdat/serve/network.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/serve/gate.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::size_t kLarge = std::size_t{24} << 20;  // more than the sockets' buffers take

class EchoSession final : public SocketSession {
 public:
  explicit EchoSession(std::shared_ptr<SocketSender> sender) : sender_(std::move(sender)) {}
  // "flood": a thousand frames and ten events at once; else the same back.
  void on_message(std::string_view bytes, bool text) override {
    if (bytes != "flood") return sender_->send_event("echo " + std::string(bytes), text);
    for (int i = 0; i < 1000; ++i) {
      sender_->send_frame("frame " + std::to_string(i) + std::string(20000, 'f'), true);
      if (i % 100 == 0) sender_->send_event("event " + std::to_string(i / 100), true);
    }
  }

 private:
  std::shared_ptr<SocketSender> sender_;
};

// Says what it was asked; "/large" is large, "/slow" waits until it is let go.
class Echo final : public Application {
 public:
  Response answer(const Request& request) override {
    if (request.target == "/large") return {200, "text/plain", std::string(kLarge, 'x'), {}};
    if (request.target == "/slow") wait();
    return {200, "text/plain", request.target + " " + request.body, {{"X-Test", "one"}}};
  }
  std::size_t body_limit(const Request& head) override { return head.target == "/mesh" ? kMaxMeshBytes : kMaxBodyBytes; }
  SocketOpening open(const Request& request) override {
    SocketOpening opening;
    opening.subprotocol = std::string(request.header("sec-websocket-protocol"));
    if (request.target == "/live")
      opening.begin = [](const std::shared_ptr<SocketSender>& sender) { return std::make_unique<EchoSession>(sender); };
    return opening;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    go_ = true;
    changed_.notify_all();
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(20), [&] { return go_; });
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  bool go_ = false;
};

class Running {
 public:
  explicit Running(NetworkOptions options = {}) : network_(options), thread_([this] { network_.serve(echo_, stop_); }) {}
  ~Running() {
    echo_.let_go();
    stop_ = true;
    thread_.join();
  }
  std::uint16_t port() const { return network_.port(); }
  Echo& echo() { return echo_; }

 private:
  Echo echo_;
  std::atomic<bool> stop_{false};
  Network network_;
  std::thread thread_;
};

class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool connected() const { return connected_; }
  void send(const std::string& bytes) const { (void)::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  // Until `enough`, the end, or 20 s.
  const std::string& read(const std::function<bool(const std::string&)>& enough) {
    char part[65536];
    while (!enough(read_)) {
      const ssize_t size = ::recv(socket_, part, sizeof part, 0);
      if (size <= 0) {
        ended_ = size == 0 || errno == ECONNRESET;
        break;
      }
      read_.append(part, static_cast<std::size_t>(size));
    }
    return read_;
  }
  std::string read_to_end() {
    return read([](const std::string&) { return false; });
  }
  std::string read_until(const std::string& text) {
    return read([&](const std::string& all) { return all.find(text) != std::string::npos; });
  }
  bool ended() const { return ended_; }

 private:
  int socket_;
  bool connected_ = false, ended_ = false;
  std::string read_;
};

std::string get(const std::string& target) { return "GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n"; }

std::string status_of(Client& client, const std::string& request) {
  client.send(request);
  return client.read_until("\r\n").substr(0, 12);
}

TEST(Network, AnswersOneRequestAfterTheOther) {
  VERIFIES("LASSO-WEB-007~1");
  const Running running;
  Client client(running.port());
  client.send(get("/a") + get("/b"));
  const std::string both = client.read_until("/b ");
  EXPECT_NE(both.find("/a "), std::string::npos);
  EXPECT_NE(both.find("X-Test: one"), std::string::npos);
  client.send("POST /c HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n\r\nbody");
  EXPECT_NE(client.read_until("/c body").find("/c body"), std::string::npos);
  for (const auto& [name, value] : safety_headers()) EXPECT_NE(both.find(name + ": " + value), std::string::npos) << name;
}

TEST(Network, AHeadHasNoBody) {
  VERIFIES("LASSO-WEB-007~1");
  const Running running;
  Client client(running.port());
  client.send("HEAD /abc HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  const std::string answer = client.read_to_end();
  EXPECT_NE(answer.find("Content-Length: 5\r\n"), std::string::npos) << answer;
  EXPECT_EQ(answer.substr(answer.size() - 4), "\r\n\r\n");
}

TEST(Network, WhatIsNoRequestIsRefusedAndTheSocketClosed) {
  VERIFIES("LASSO-WEB-004~1");
  const Running running;
  const std::pair<std::string, std::string> cases[] = {
      {"GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", "HTTP/1.1 501"},
      {"POST / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\nContent-Length: 3\r\n\r\nabc", "HTTP/1.1 "},
      {"GET / HTTP/1.1\r\nX: " + std::string(9000, 'x') + "\r\n\r\n", "HTTP/1.1 431"},
      {"POST / HTTP/1.1\r\nContent-Length: 70000\r\n\r\n", "HTTP/1.1 413"},
      {"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n", "HTTP/1.1 400"},
      {"POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nab", "HTTP/1.1 400"},
      {"POST / HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 1\r\n\r\n", "HTTP/1.1 417"},
      {"GET /\x01 HTTP/1.1\r\n\r\n", "HTTP/1.1 400"},
      {"nonsense\r\n\r\n", "HTTP/1.1 400"},
      {"GET / HTTP/9.9\r\n\r\n", "HTTP/1.1 400"}};
  for (const auto& [request, status] : cases) {
    Client client(running.port());
    EXPECT_EQ(status_of(client, request).substr(0, status.size()), status) << request.substr(0, 60);
    (void)client.read_to_end();
    EXPECT_TRUE(client.ended()) << request.substr(0, 60);
  }
}

TEST(Network, ALargeBodyIsTakenWhereTheApplicationSaysSo) {
  VERIFIES("LASSO-WEB-032~2");
  const Running running;
  const std::string body(std::size_t{3} << 20, 'm');
  Client client(running.port());
  client.send("POST /mesh HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  const std::string answer = client.read_to_end();
  EXPECT_EQ(answer.substr(answer.size() - body.size()), body);
  for (const bool mesh : {true, false}) {
    const std::string target = mesh ? "/mesh" : "/other";
    Client refused(running.port());
    const std::size_t size = mesh ? kMaxMeshBytes + 1 : body.size();
    EXPECT_EQ(status_of(refused, "POST " + target + " HTTP/1.1\r\nContent-Length: " + std::to_string(size) + "\r\n\r\n"), "HTTP/1.1 413");
  }
}

TEST(Network, AnyBytesLeaveItServing) {
  VERIFIES("LASSO-WEB-004~1");
  const Running running;
  sim::Random random(23);
  const std::string good = "POST /a?b=c HTTP/1.1\r\nHost: x\r\nCookie: a=b\r\nContent-Length: 5\r\n\r\nhello";
  for (int trial = 0; trial < 150; ++trial) {
    std::string bytes = good;
    for (std::uint64_t i = random.bits() % 6; i > 0; --i) bytes[random.bits() % bytes.size()] = static_cast<char>(random.bits());
    Client client(running.port());
    client.send(bytes.substr(0, random.bits() % (bytes.size() + 1)));
  }
  Client client(running.port());
  EXPECT_EQ(status_of(client, get("/after")), "HTTP/1.1 200");
}

TEST(Network, WhoSendsOrReadsTooSlowlyIsCutOff) {
  VERIFIES("LASSO-WEB-007~1");
  NetworkOptions options;
  options.header_time = options.idle_time = options.answer_time = std::chrono::milliseconds(150);
  const Running running(options);
  Client silent(running.port()), half(running.port()), idle(running.port()), deaf(running.port());
  half.send("GET / HTTP/1.1\r\nHos");
  deaf.send(get("/large"));
  EXPECT_EQ(status_of(idle, get("/")), "HTTP/1.1 200");
  for (Client* client : {&silent, &half, &idle}) {
    (void)client->read_to_end();
    EXPECT_TRUE(client->ended());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(400));  // it does not read meanwhile
  EXPECT_LT(deaf.read_to_end().size(), kLarge);
}

TEST(Network, FiftyClientsAreServedBesideSlowOnes) {
  VERIFIES("LASSO-WEB-007~1");
  Running running;
  Client slow(running.port()), deaf(running.port());
  slow.send(get("/slow"));
  deaf.send(get("/large"));
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 50; ++i) clients.push_back(std::make_unique<Client>(running.port()));
  for (std::size_t i = 0; i < clients.size(); ++i) clients[i]->send(get("/client" + std::to_string(i)));
  for (std::size_t i = 0; i < clients.size(); ++i)
    EXPECT_NE(clients[i]->read_until("/client" + std::to_string(i) + " ").find("200 OK"), std::string::npos) << i;
  running.echo().let_go();
  EXPECT_NE(slow.read_until("/slow ").find("200 OK"), std::string::npos);
}

TEST(Network, MoreSocketsThanItsLimitAreClosed) {
  VERIFIES("LASSO-WEB-007~1");
  NetworkOptions options;
  options.sockets = 3;
  const Running running(options);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<Client>(running.port()));
    EXPECT_EQ(status_of(*clients.back(), get("/")), "HTTP/1.1 200");
  }
  Client more(running.port());
  EXPECT_EQ(status_of(more, get("/")), "");
  EXPECT_TRUE(more.ended());
}

TEST(Network, AnAddressInUseIsOneLine) {
  VERIFIES("LASSO-WEB-014~1");
  const Running running;
  NetworkOptions options;
  options.port = running.port();
  try {
    const Network second(options);
    FAIL() << "two listen on one port";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("127.0.0.1:" + std::to_string(options.port) + ": another program listens there"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
  options.host = "no such host";
  EXPECT_THROW((void)Network(options), InputError);
}

// A frame of a client (RFC 6455), masked with zeros.
std::string masked(const std::string& text) {
  std::string bytes = "\x81";
  bytes.push_back(static_cast<char>(0x80 | text.size()));
  return bytes + std::string(4, '\0') + text;
}
constexpr char kUpgrade[] =
    " HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: "
    "dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: "
    "13\r\nSec-WebSocket-Protocol: test.v1\r\n\r\n";

TEST(Network, ASocketTalksBothWays) {
  VERIFIES("LASSO-WEB-018~1");
  const Running running;
  Client client(running.port());
  client.send(std::string("GET /live") + kUpgrade);
  const std::string head = client.read_until("\r\n\r\n");
  EXPECT_NE(head.find("101 Switching"), std::string::npos) << head;
  EXPECT_NE(head.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos);  // of this key, as RFC 6455 has it
  EXPECT_NE(head.find("Sec-WebSocket-Protocol: test.v1"), std::string::npos);
  client.send(masked("hello"));
  EXPECT_NE(client.read_until("echo hello").find("echo hello"), std::string::npos);
  Client refused(running.port());
  EXPECT_EQ(status_of(refused, std::string("GET /other") + kUpgrade), "HTTP/1.1 404");
}

TEST(Network, FramesAreDroppedForASlowReaderAndEventsAreNot) {
  VERIFIES("LASSO-WEB-018~1");
  const Running running;
  Client client(running.port());
  client.send(std::string("GET /live") + kUpgrade);
  (void)client.read_until("\r\n\r\n");
  client.send(masked("flood"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // it does not read meanwhile
  client.send(masked("end"));
  const std::string all = client.read_until("echo end");
  std::size_t frames = 0;
  for (std::size_t at = all.find("frame "); at != std::string::npos; at = all.find("frame ", at + 1)) ++frames;
  EXPECT_LT(frames, 1000U);
  EXPECT_NE(all.find("frame 999"), std::string::npos);  // the newest
  std::size_t at = 0;
  for (int i = 0; i < 10; ++i) {
    const std::size_t next = all.find("event " + std::to_string(i), at);
    ASSERT_NE(next, std::string::npos) << i;  // each, in order
    at = next;
  }
}

}  // namespace
}  // namespace lasso::mdat::serve

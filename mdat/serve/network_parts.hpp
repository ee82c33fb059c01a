// What the sockets of one server share. For network.cpp alone, as all network_*.hpp.
#pragma once

#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <memory>
#include <string>

#include "mdat/serve/network.hpp"

namespace lasso::mdat::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;

struct Shared {
  const NetworkOptions& options;
  Application& application;
  asio::thread_pool& workers;  // answers are made there, so that a long one keeps nobody else waiting
  std::atomic<std::size_t>& sockets;
};

// Counts a socket as long as it lives.
class SocketCount {
 public:
  explicit SocketCount(std::atomic<std::size_t>& count) : count_(count) { ++count_; }
  ~SocketCount() { --count_; }
  SocketCount(const SocketCount&) = delete;
  SocketCount& operator=(const SocketCount&) = delete;

 private:
  std::atomic<std::size_t>& count_;
};

using Header = http::request_header<>;

inline Method method_of(http::verb verb) {
  if (verb == http::verb::get) return Method::kGet;
  if (verb == http::verb::head) return Method::kHead;
  return verb == http::verb::post ? Method::kPost : Method::kOther;
}

inline std::string text_of(boost::string_view view) { return {view.data(), view.size()}; }

inline Request request_of(const Header& header, std::string body) {
  Request request;
  request.method = method_of(header.method());
  request.target = text_of(header.target());
  for (const auto& field : header) {
    std::string name = text_of(field.name_string());
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    std::string& value = request.headers[name];
    value += (value.empty() ? "" : ", ") + text_of(field.value());
  }
  request.body = std::move(body);
  return request;
}

}  // namespace lasso::mdat::serve

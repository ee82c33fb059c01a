// A connection that speaks HTTP: one request after the other, each answered by a worker. For network.cpp alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mdat/serve/gate.hpp"
#include "mdat/serve/network_parts.hpp"
#include "mdat/serve/network_socket.hpp"

namespace lasso::mdat::serve {

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Tcp::socket socket, const Shared& shared)
      : stream_(std::move(socket)), shared_(shared), count_(std::make_shared<SocketCount>(shared.sockets)) {}

  void start() {
    asio::dispatch(stream_.get_executor(), [self = shared_from_this()] { self->read(self->shared_.options.header_time); });
  }

 private:
  using Parser = http::request_parser<http::string_body>;

  void read(std::chrono::milliseconds time) {
    parser_ = std::make_unique<Parser>();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(kMaxMeshBytes);
    stream_.expires_after(time);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->fail(error);
      self->read_body();
    });
  }

  void read_body() {
    const Header& header = parser_->get().base();
    if (header.count(http::field::transfer_encoding) > 0)
      return send(error_response(501, "Transfer-Encoding is not taken", "send the body with its Content-Length"), false);
    if (header.count(http::field::expect) > 0) return send(error_response(417, "Expect is not taken", "leave it out"), false);
    if (websocket::is_upgrade(parser_->get())) return open_socket();
    const std::uint64_t size = parser_->content_length().value_or(0);
    const std::size_t limit = size > kMaxBodyBytes ? shared_.application.body_limit(request_of(header, "")) : kMaxBodyBytes;
    if (size > limit) return send(too_large_response(limit, size), false);
    stream_.expires_after(shared_.options.header_time + time_for(size));
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->fail(error);
      self->answer();
    });
  }

  // What a large body may take longer: a second a megabyte.
  static std::chrono::milliseconds time_for(std::uint64_t bytes) { return std::chrono::milliseconds(1000 * (bytes >> 20)); }

  void answer() {
    head_ = parser_->get().method() == http::verb::head;
    const bool keep = parser_->get().keep_alive();
    stream_.expires_never();
    auto request = std::make_shared<Request>(request_of(parser_->get().base(), std::move(parser_->get().body())));
    asio::post(shared_.workers, [self = shared_from_this(), request, keep] {
      auto response = std::make_shared<Response>(self->shared_.application.answer(*request));
      asio::post(self->stream_.get_executor(), [self, response, keep] { self->send(std::move(*response), keep); });
    });
  }

  // The stream goes over to the socket, or answers with what refuses it.
  void open_socket() {
    Header header = parser_->get().base();
    SocketOpening opening = shared_.application.open(request_of(header, ""));
    if (opening.begin) return std::make_shared<Socket>(std::move(stream_), shared_, count_)->accept(std::move(header), opening);
    send(opening.refusal ? std::move(*opening.refusal) : error_response(404, "no socket is served here", "see docs/serve.md"), false);
  }

  void send(Response response, bool keep) {
    auto message = std::make_shared<http::response<http::string_body>>(static_cast<http::status>(response.status), 11);
    message->set(http::field::server, "mdat");
    message->set(http::field::content_type, response.type);
    for (const auto& [name, value] : safety_headers()) message->set(name, value);
    for (const auto& [name, value] : response.headers) message->insert(name, value);
    message->keep_alive(keep);
    const std::size_t size = response.body.size();
    if (!head_) message->body() = std::move(response.body);
    message->content_length(size);
    stream_.expires_after(shared_.options.answer_time);
    auto serializer = std::make_shared<http::response_serializer<http::string_body>>(*message);
    const auto sent = [self = shared_from_this(), message, serializer, keep](beast::error_code error, std::size_t) {
      if (error || !keep) return self->close();
      self->read(self->shared_.options.idle_time);
    };
    head_ ? http::async_write_header(stream_, *serializer, sent) : http::async_write(stream_, *serializer, sent);
  }

  // What a client sent that is no request is told so, where it still listens.
  void fail(beast::error_code error) {
    if (error == http::error::header_limit) return send(error_response(431, "the headers are too large", "send less than 8 kB"), false);
    if (error == http::error::body_limit) return send(too_large_response(kMaxMeshBytes), false);
    const bool spoke = error.category() == http::make_error_code(http::error::bad_method).category();
    if (spoke && error != http::error::end_of_stream && error != http::error::partial_message)
      return send(error_response(400, "this is no HTTP request: " + error.message(), "send HTTP/1.1"), false);
    close();
  }

  // Lets the client read what was sent before the end.
  void close() {
    beast::error_code ignored;
    ignored = stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    stream_.expires_after(std::chrono::milliseconds(200));
    stream_.async_read_some(asio::buffer(rest_), [self = shared_from_this()](beast::error_code, std::size_t) { self->stream_.close(); });
  }

  beast::tcp_stream stream_;
  Shared shared_;
  std::shared_ptr<SocketCount> count_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxBodyBytes + kMaxHeaderBytes};
  std::unique_ptr<Parser> parser_;
  std::array<char, 4096> rest_{};
  bool head_ = false;
};

}  // namespace lasso::mdat::serve

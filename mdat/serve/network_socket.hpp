// A WebSocket with its queue. For network.cpp alone.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "mdat/serve/network_parts.hpp"

namespace lasso::mdat::serve {

// Calls of SocketSender come from any thread, and go on in the socket's strand.
class Socket final : public SocketSender, public std::enable_shared_from_this<Socket> {
 public:
  Socket(beast::tcp_stream stream, const Shared& shared, std::shared_ptr<SocketCount> count)
      : stream_(std::move(stream)), shared_(shared), count_(std::move(count)) {}

  void send_frame(std::string bytes, bool text) override { post({std::move(bytes), text, true}); }
  void send_event(std::string bytes, bool text) override { post({std::move(bytes), text, false}); }
  void close() override {
    asio::post(stream_.get_executor(), [self = shared_from_this()] { self->shut(); });
  }

  // Answers the request for an upgrade, and then reads.
  void accept(Header header, const SocketOpening& opening) {
    session_ = opening.begin(shared_from_this());
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.read_message_max(shared_.options.socket_message_bytes);
    stream_.set_option(websocket::stream_base::decorator([name = opening.subprotocol](websocket::response_type& response) {
      if (!name.empty()) response.set(http::field::sec_websocket_protocol, name);
    }));
    header_ = std::move(header);
    stream_.async_accept(http::request<http::empty_body>(header_), [self = shared_from_this()](beast::error_code error) {
      if (error) return self->shut();
      self->open_ = true;
      self->write();
      self->read();
    });
  }

 private:
  struct Waiting {
    std::string bytes;
    bool text, frame;
  };

  void post(Waiting message) {
    asio::post(stream_.get_executor(),
               [self = shared_from_this(), message = std::move(message)]() mutable { self->queue(std::move(message)); });
  }

  // The message that is being written is the first, and stays.
  void queue(Waiting message) {
    if (closed_) return;
    std::size_t& waiting = message.frame ? frames_ : events_;
    if (message.frame && waiting >= shared_.options.waiting_frames) drop_oldest_frame();
    if (!message.frame && waiting >= shared_.options.waiting_events) return shut();
    ++waiting;
    queue_.push_back(std::move(message));
    write();
  }

  void drop_oldest_frame() {
    for (auto at = queue_.begin() + (writing_ ? 1 : 0); at != queue_.end(); ++at) {
      if (!at->frame) continue;
      queue_.erase(at);
      --frames_;
      return;
    }
  }

  void write() {
    if (!open_ || closed_ || writing_ || queue_.empty()) return;
    writing_ = true;
    stream_.text(queue_.front().text);
    stream_.async_write(asio::buffer(queue_.front().bytes), [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->writing_ = false;
      if (error) return self->shut();
      --(self->queue_.front().frame ? self->frames_ : self->events_);
      self->queue_.pop_front();
      self->write();
    });
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->closed_) return self->shut();
      const std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (self->session_) self->session_->on_message(message, self->stream_.got_text());
      self->read();
    });
  }

  void shut() {
    if (std::exchange(closed_, true)) return;
    session_.reset();
    beast::get_lowest_layer(stream_).close();
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared shared_;
  std::shared_ptr<SocketCount> count_;
  Header header_;
  beast::flat_buffer buffer_;
  std::unique_ptr<SocketSession> session_;
  std::deque<Waiting> queue_;
  std::size_t frames_ = 0, events_ = 0;  // in the queue
  bool open_ = false, writing_ = false, closed_ = false;
};

}  // namespace lasso::mdat::serve

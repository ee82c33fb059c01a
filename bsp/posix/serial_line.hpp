// A byte line of Linux: a serial device, a pseudo-terminal, TCP or a Unix socket. Nothing here waits; each refusal is a sentence that names
// the line, the cause and the remedy.
//
// Addresses: tcp://HOST:PORT (HOST a number such as 127.0.0.1, or localhost; of other machines only with `remote`), unix:PATH, or the path
// of a serial device; to listen on, pty makes a new pseudo-terminal.
#pragma once

#include <cstddef>
#include <string>

#include "fsw/core/span.hpp"

namespace lasso::posix {

// One end of a line. A serial device is taken for this program alone (flock, TIOCEXCL), raw, 8 data bits, no parity, 1 stop bit.
class SerialLine {
 public:
  SerialLine() = default;
  explicit SerialLine(int descriptor) : fd_(descriptor) {}
  ~SerialLine() { close(); }
  SerialLine(SerialLine&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  SerialLine& operator=(SerialLine&& other) noexcept;

  // Empty, or why a line of this address cannot be opened, as far as can be told without opening it: not there, not allowed, no address.
  static std::string check(const std::string& address, bool remote);
  // Empty when the line is open; otherwise why it is not: nobody listens, not there, taken, not allowed, no address.
  std::string open(const std::string& address, unsigned bits_per_s, bool remote);
  bool is_open() const { return fd_ >= 0; }
  int descriptor() const { return fd_; }
  void close();

  // As many bytes as there are, or as fit; 0: none now, or the other end has gone, which closes the line.
  std::size_t read(Bytes out);
  std::size_t write(ConstBytes bytes);

 private:
  std::size_t settle(long result);
  int fd_ = -1;
};

// The end that others open. One of them at a time: while it is there nobody else is let in.
class LineServer {
 public:
  LineServer() = default;
  ~LineServer() { close(); }
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  // Empty, or why not: taken, not allowed, no address.
  std::string listen(const std::string& address, bool remote);
  // By which it is opened: with the port that was given for port 0, the path of the pseudo-terminal.
  const std::string& address() const { return address_; }
  // Whether somebody has come; `line` then is open, and no other is let in until the next call.
  bool accept(SerialLine& line);
  void close();

 private:
  std::string listen_again();
  std::string address_, unix_path_;
  bool remote_ = false;
  bool pty_ = false;
  int fd_ = -1;
};

}  // namespace lasso::posix

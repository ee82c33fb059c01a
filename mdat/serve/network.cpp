#include "mdat/serve/network.hpp"

#include <algorithm>
#include <thread>
#include <vector>

#include "mdat/common/errors.hpp"
#include "mdat/serve/network_http.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::chrono::milliseconds kLook(100);  // at the wish to stop
constexpr std::size_t kNetworkThreads = 2, kWorkers = 4;

// A name may stand for several addresses: the first.
Tcp::endpoint endpoint_of(asio::io_context& io, const NetworkOptions& options) {
  std::string host = options.host;
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  beast::error_code error;
  Tcp::resolver resolver(io);
  const auto found = resolver.resolve(host, std::to_string(options.port), Tcp::resolver::passive, error);
  if (error || found.empty()) throw InputError("--host " + options.host + ": no such address: " + error.message());
  return found.begin()->endpoint();
}

}  // namespace

struct Network::Parts {
  explicit Parts(const NetworkOptions& network) : options(network) {}

  void listen() {
    const Tcp::endpoint endpoint = endpoint_of(io, options);
    const std::string place = options.host + ":" + std::to_string(options.port);
    try {
      acceptor.open(endpoint.protocol());
      acceptor.set_option(asio::socket_base::reuse_address(true));
      acceptor.bind(endpoint);
      acceptor.listen(asio::socket_base::max_listen_connections);
    } catch (const boost::system::system_error& error) {
      const bool used = error.code() == asio::error::address_in_use;
      throw InputError(place + (used ? ": another program listens there: choose another port, or 0 for any that is free"
                                     : ": cannot be listened on: " + error.code().message()));
    }
  }

  void accept(const Shared& shared) {
    acceptor.async_accept(asio::make_strand(io), [this, shared](beast::error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && sockets < options.sockets) {
        beast::error_code ignored;
        ignored = socket.set_option(Tcp::no_delay(true), ignored);
        std::make_shared<Connection>(std::move(socket), shared)->start();
      }
      accept(shared);
    });
  }

  void look(const std::atomic<bool>& stop) {
    timer.expires_after(kLook);
    timer.async_wait([this, &stop](beast::error_code error) {
      if (error) return;
      stop ? io.stop() : look(stop);
    });
  }

  NetworkOptions options;
  asio::io_context io;
  Tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::atomic<std::size_t> sockets{0};
};

Network::Network(const NetworkOptions& options) : parts_(std::make_unique<Parts>(options)) { parts_->listen(); }

Network::~Network() = default;

std::uint16_t Network::port() const { return parts_->acceptor.local_endpoint().port(); }

void Network::serve(Application& application, const std::atomic<bool>& stop) {
  asio::thread_pool workers(kWorkers);
  const Shared shared{parts_->options, application, workers, parts_->sockets};
  parts_->accept(shared);
  parts_->look(stop);
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < kNetworkThreads; ++i) threads.emplace_back([this] { parts_->io.run(); });
  parts_->io.run();
  for (std::thread& thread : threads) thread.join();
  workers.join();
  parts_->acceptor.close();
}

}  // namespace lasso::mdat::serve

#include "mdat/serve/live_server.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/recording/frame_recorder.hpp"
#include "mdat/serve/gate.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::chrono::milliseconds kFarewell(500);
constexpr std::string_view kTellAll[] = {"/events", "/scene"};  // never dropped, and kept
constexpr std::string_view kForReplay = "/sensor_scans";

// By digits: a name that begins so may belong to anybody.
bool is_loopback_name(std::string_view name) {
  const bool digits = name.find_first_not_of("0123456789.") == std::string_view::npos;
  return name == "localhost" || name == "[::1]" || name == "::1" || (digits && name.rfind("127.", 0) == 0);
}

// "localhost:8765" without its port; an IPv6 address stands in brackets.
std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && (host.front() != '[' || host[colon - 1] == ']');
  return has_port ? host.substr(0, colon) : host;
}

// A page of the web that is not of this machine. Programs send no Origin, and desktop viewers one of another kind. "null" is that of frames
// in a sandbox, which any page may hold.
bool is_from_elsewhere(std::string_view origin) {
  if (origin == "null") return true;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.rfind(scheme, 0) == 0) return !is_loopback_name(without_port(origin.substr(scheme.size())));
  }
  return false;
}

std::vector<std::size_t> shown_topics(const std::vector<MessageTopic>& topics) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].name != kForReplay) shown.push_back(i);
  }
  return shown;
}

}  // namespace

struct LiveHub::Client {
  explicit Client(const std::shared_ptr<SocketSender>& to) : sender(to) {}
  // The socket keeps its session, and the session this: not the other way round.
  const std::weak_ptr<SocketSender> sender;
  std::mutex mutex;
  std::map<std::size_t, std::uint32_t> subscriptions;  // by topic

  void tell(StatusLevel level, const std::string& message) const {
    if (const auto to = sender.lock()) to->send_event(status_json(level, message), true);
  }
};

class LiveHub::Session final : public SocketSession {
 public:
  Session(LiveHub& hub, std::shared_ptr<Client> client) : hub_(hub), client_(std::move(client)) { ++hub_.sessions_; }
  ~Session() override { hub_.leave(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void on_message(std::string_view bytes, bool text) override {
    const ClientMessage message = client_message(bytes, text);
    if (const auto* subscribe = std::get_if<Subscribe>(&message)) hub_.subscribe(*client_, subscribe->subscriptions);
    if (const auto* unsubscribe = std::get_if<Unsubscribe>(&message)) hub_.unsubscribe(*client_, unsubscribe->ids);
    if (const auto* request = std::get_if<PlaybackRequest>(&message)) hub_.control(*client_, *request);
    if (const auto* wrong = std::get_if<Misunderstood>(&message)) client_->tell(StatusLevel::kError, wrong->what);
  }

 private:
  LiveHub& hub_;
  std::shared_ptr<Client> client_;
};

LiveHub::LiveHub(std::string host, std::string run, Playback* playback)
    : host_(std::move(host)), run_(std::move(run)), session_(random_token()), playback_(playback), topics_(recorded_topics()) {}

std::vector<std::shared_ptr<LiveHub::Client>> LiveHub::listening() const {
  std::vector<std::shared_ptr<Client>> clients;
  for (const std::weak_ptr<Client>& one : clients_) {
    if (std::shared_ptr<Client> client = one.lock()) clients.push_back(std::move(client));
  }
  return clients;
}

void LiveHub::on_message(std::size_t topic, std::uint64_t time_ns, std::string_view bytes) {
  const std::string& name = topics_.at(topic).name;
  if (name == kForReplay) return;
  const bool event = std::find(std::begin(kTellAll), std::end(kTellAll), name) != std::end(kTellAll);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (event) {
    std::deque<Kept>& kept = kept_[topic];
    kept.push_back({time_ns, std::string(bytes)});
    if (kept.size() > kKeptEvents) kept.pop_front();
  }
  const bool later = time_ns > told_ns_;
  told_ns_ = std::max(told_ns_, time_ns);
  for (const std::shared_ptr<Client>& client : listening()) {
    const std::lock_guard<std::mutex> subscribed(client->mutex);
    const auto sender = client->sender.lock();
    if (!sender) continue;
    if (later) sender->send_frame(time_data(time_ns), false);
    const auto subscription = client->subscriptions.find(topic);
    if (subscription == client->subscriptions.end()) continue;
    std::string message = message_data(subscription->second, time_ns, bytes);
    if (event) {
      sender->send_event(std::move(message), false);
    } else {
      sender->send_frame(std::move(message), false);
    }
  }
}

// Under both locks, so that what is kept comes once, and before what follows.
void LiveHub::subscribe(Client& client, const std::vector<Subscription>& asked) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::lock_guard<std::mutex> subscribed(client.mutex);
  const auto sender = client.sender.lock();
  for (const auto& [id, channel] : asked) {
    const bool is_known = channel < topics_.size() && topics_[channel].name != kForReplay;
    const bool is_used = std::any_of(client.subscriptions.begin(), client.subscriptions.end(),
                                     [asked_id = id](const auto& one) { return one.second == asked_id; });
    if (!is_known || is_used || client.subscriptions.count(channel) > 0) {
      client.tell(StatusLevel::kError,
                  "subscribe: channel " + std::to_string(channel) + (is_known ? " or this id is subscribed already" : " is not there"));
      continue;
    }
    client.subscriptions[channel] = id;
    if (!sender) continue;
    for (const Kept& kept : kept_[channel]) sender->send_event(message_data(id, kept.time_ns, kept.bytes), false);
  }
}

void LiveHub::unsubscribe(Client& client, const std::vector<std::uint32_t>& ids) {
  const std::lock_guard<std::mutex> subscribed(client.mutex);
  for (const std::uint32_t id : ids) std::erase_if(client.subscriptions, [id](const auto& one) { return one.second == id; });
}

void LiveHub::control(const Client& client, const PlaybackRequest& request) {
  if (playback_ == nullptr) return client.tell(StatusLevel::kError, "playback control: this run keeps the clock of its link");
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string refused = playback_->take(request, told_ns_);
  if (!refused.empty()) client.tell(StatusLevel::kWarning, refused);
  tell_playback(&client, request.id);
}

// Who asked is told which request it is that is answered.
void LiveHub::tell_playback(const Client* asked, const std::string& request) {
  const PlaybackState state = playback_->state(told_ns_);
  for (const std::shared_ptr<Client>& client : listening()) {
    const auto sender = client->sender.lock();
    if (sender) sender->send_event(playback_state_data(state, client.get() == asked ? request : ""), false);
  }
}

// Without a lock: the last one who holds a socket may be the run, under its own.
void LiveHub::leave() {
  if (--sessions_ == 0 && playback_ != nullptr) playback_->release();
}

Response LiveHub::answer(const Request& request) {
  if (std::optional<Response> refusal = refuse(request)) return std::move(*refusal);
  return error_response(426, "a WebSocket is served here: " + run_,
                        "open this address as a Foxglove WebSocket (ws://) in Lichtblick or Foxglove (docs/live.md)");
}

std::optional<Response> LiveHub::refuse(const Request& request) const {
  const std::string_view host = without_port(request.header("host"));
  if (!is_loopback_name(host) && host != host_) return error_response(403, "this Host is not served", "use the address that mdat printed");
  if (is_from_elsewhere(request.header("origin")))
    return error_response(403, "pages from elsewhere are not served", "open the viewer from this machine, or as a program of its own");
  return std::nullopt;
}

SocketOpening LiveHub::open(const Request& request) {
  if (std::optional<Response> refusal = refuse(request)) return {"", {}, std::move(refusal)};
  const std::string subprotocol = live_subprotocol(request.header("sec-websocket-protocol"));
  if (subprotocol.empty())
    return {"", {}, error_response(400, "no known subprotocol is offered", "offer foxglove.sdk.v1 or foxglove.websocket.v1")};
  return {subprotocol,
          [this](const std::shared_ptr<SocketSender>& sender) -> std::unique_ptr<SocketSession> {
            auto client = std::make_shared<Client>(sender);
            sender->send_event(server_info_json(run_, session_, playback_ != nullptr ? std::optional(playback_->range()) : std::nullopt),
                               true);
            sender->send_event(advertise_json(topics_, shown_topics(topics_)), true);
            const std::lock_guard<std::mutex> lock(mutex_);
            if (playback_ != nullptr) sender->send_event(playback_state_data(playback_->state(told_ns_), ""), false);
            std::erase_if(clients_, [](const std::weak_ptr<Client>& one) { return one.expired(); });
            clients_.push_back(client);
            return std::make_unique<Session>(*this, std::move(client));
          },
          std::nullopt};
}

void LiveHub::say(const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::shared_ptr<Client>& client : listening()) client->tell(StatusLevel::kInfo, message);
}

void LiveHub::end(const std::string& message) {
  say(message);
  if (playback_ == nullptr) return;
  playback_->end();
  const std::lock_guard<std::mutex> lock(mutex_);
  tell_playback(nullptr, "");
}

std::size_t LiveHub::clients() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return listening().size();
}

LiveServer::LiveServer(const NetworkOptions& options, const std::string& run, Playback* playback)
    : hub_(options.host, run, playback), network_(options), host_(options.host), thread_([this] { network_.serve(hub_, stop_); }) {}

LiveServer::~LiveServer() {
  stop_ = true;
  thread_.join();
}

std::string LiveServer::address() const { return "ws://" + host_ + ":" + std::to_string(network_.port()); }

void LiveServer::end(const std::string& message) {
  if (hub_.clients() == 0) return;
  hub_.end(message);
  std::this_thread::sleep_for(kFarewell);
}

void read_address(const std::string& text, NetworkOptions& options) {
  const bool only_port = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  const std::string_view host = only_port || text.empty() ? std::string_view() : without_port(text);
  if (!host.empty()) options.host = host;
  if (!only_port && host.size() == text.size()) return;
  const std::string port = only_port ? text : text.substr(host.size() + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), options.port);
  if (error != std::errc() || end != port.data() + port.size())
    throw InputError("--live " + text + ": expected HOST:PORT, such as 127.0.0.1:8765, or one of them");
}

}  // namespace lasso::mdat::serve

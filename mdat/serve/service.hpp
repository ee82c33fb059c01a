// What mdat serve answers: who may ask (gate.hpp), then the page, or a part of the interface for programs (docs/serve.md).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "mdat/serve/answers.hpp"
#include "mdat/serve/application.hpp"
#include "mdat/serve/design.hpp"
#include "mdat/serve/folder.hpp"
#include "mdat/serve/gate.hpp"
#include "mdat/serve/jobs.hpp"
#include "mdat/serve/live.hpp"
#include "mdat/serve/page_files.hpp"

namespace lasso::mdat::serve {

struct ServiceOptions {
  std::string commit;               // of the program
  std::span<const PageFile> files;  // of the page
  Live* live = nullptr;             // which outlives the service; null: nothing can be flown
};

class Service final : public Application {
 public:
  // `gate` and `folder` outlive it.
  Service(const Gate& gate, Folder& folder, ServiceOptions options) : gate_(gate), folder_(folder), options_(std::move(options)) {
    if (options_.live != nullptr) design_.emplace(folder_, *options_.live);
  }

  Response answer(const Request& request) override;
  // A large body is taken from those alone who may ask.
  std::size_t body_limit(const Request& head) override;
  // That of /api/live/socket alone.
  SocketOpening open(const Request& request) override;

 private:
  std::optional<Response> refuse(const Request& request, const Target& target) const;
  Response route(const Request& request, const Target& target);
  Response route_api(const Request& request, const Target& target);
  Response route_recording(const Target& target);
  Response route_frame(const Shown& shown, const Target& target);
  Response about() const;
  Response recordings();
  Response first();
  Response job(const std::string& id) const;

  const Gate& gate_;
  Folder& folder_;
  ServiceOptions options_;
  std::optional<Design> design_;  // where missions can be flown
  Jobs jobs_;
};

}  // namespace lasso::mdat::serve

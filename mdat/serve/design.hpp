// Missions as texts that the page edits. The text is the only truth: an edit of a form is a change of a span of it, made here.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "mdat/serve/folder.hpp"
#include "mdat/serve/live.hpp"

namespace lasso::mdat::serve {

struct MissionText {
  std::string text, digest;  // SHA-256, by which a file that was changed meanwhile is told
};

// Safe for several threads.
class Design {
 public:
  // Both outlive it.
  Design(const Folder& folder, const Live& live) : folder_(folder), live_(live) {}

  // Throws Refusal: 404 there is no such mission; 409 the file cannot be read.
  MissionText open(const LiveMission& mission) const;
  // The text with these values, KEY=VALUE each, as `mdat mission set` would change it. Throws Refusal (422).
  static std::string set(const LiveMission& mission, const std::string& text, const std::vector<std::string>& settings);
  // Writes the text, if the file is still the one of `digest`. Gives its new digest. Throws Refusal: 403 a shipped mission; 409 the file
  // is another one meanwhile, or cannot be written; 422 the text is no valid mission.
  std::string save(const LiveMission& mission, const std::string& text, const std::string& digest);
  // Copies the mission with all files that it names into a new folder of this name; gives the copy's id. Throws Refusal: 400 the name is
  // none, 409 it is taken, or nothing can be written there, 422 the mission is not valid.
  std::string copy(const LiveMission& mission, const std::string& name);

  LiveMission mission(const std::string& id) const { return live_.mission(id); }
  const Folder& folder() const { return folder_; }

 private:
  const Folder& folder_;
  const Live& live_;
  std::mutex writing_;
};

}  // namespace lasso::mdat::serve

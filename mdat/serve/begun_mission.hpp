// A mission for a mesh that was sent: what `mdat mission new` writes, in a new folder below the served one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/serve/folder.hpp"

namespace lasso::mdat::serve {

struct MeshOrder {
  std::string name;                  // of the new folder, and of the mission in it
  std::string file, bytes;           // the target's file, by its own name, whose ending says the kind
  std::optional<SensorKind> sensor;  // otherwise guessed from the target's size
  double scale = 1;                  // the file's lengths times this are metres
  std::size_t simplify = 0;          // triangles of a coarser mesh; 0: none, kSimplifyChosen: a quarter of them
};

struct BegunMission {
  std::string id;                    // NAME/NAME.toml
  std::vector<std::string> remarks;  // what was guessed
  std::string command;               // that does the same with the file
};

// Any number at a time. Takes as long as the model's compilation. Throws Refusal, and leaves nothing behind: 400 the name or the file's
// name is none, 409 the name is taken, or nothing can be written here, 422 mission new refuses the file, in its words.
BegunMission begin_mission(const Folder& folder, const MeshOrder& order);

}  // namespace lasso::mdat::serve

// The emulated board between two slots: its memory as a file that is shared with it, its registers by the emulator's debug port, its
// lines. At each boundary between slots the board waits for the rig; that state can be kept, and put back as often as it is wanted: the
// board then flies on from there as it did (docs/decisions/flips-on-the-target.md).
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "ft/pil/board_ram.hpp"
#include "ft/pil/gdb_stub.hpp"
#include "ft/pil/line.hpp"

namespace lasso::pil {

struct Range {
  std::uint32_t address = 0, bytes = 0;
};
// Places of the board by name: what ft/pil/seu.py has read out of the image.
using Places = std::map<std::string, std::vector<Range>>;
Places read_places(const std::string& file);

struct LineCounts {
  std::uint32_t camera_taken = 0, camera_given = 0, ground_taken = 0, ground_given = 0;
};

// What can be put back. Code, constants and the mission's image, in its buffer and in the store, are not in it: nothing but a flip changes
// them.
struct Snapshot {
  Packet memory, stack, log;
  std::string registers;
  LineCounts counts;
};

// What the board has said up to a report.
struct Said {
  bool begun = false;  // the report of a start
  Packet to_camera, telemetry;
};

class SeuBoard {
 public:
  // Emulators come and go in `folder`; ram.bin is their memory.
  SeuBoard(std::string folder, const Places& places, std::function<void()> start_emulator);
  SeuBoard(const SeuBoard&) = delete;
  SeuBoard& operator=(const SeuBoard&) = delete;

  // A new emulator, up to the report of its start.
  void begin();
  // Code, constants and image as they are now are those to be put back.
  void keep_constants();

  void give(const Packet& from_camera, const Packet& from_ground);
  // Until the next report; `stopped` is called at each breakpoint. None: there was none within `patience_s`,
  // whatever else the board has said.
  std::optional<Said> await(int patience_s, const std::function<void()>& stopped = {});

  Snapshot keep();
  void put_back(const Snapshot& snapshot);

  std::uint8_t* at(std::uint32_t address) { return ram_ + address; }
  // Whatever it is: code is translated anew.
  void flip(std::uint32_t address, std::uint8_t bit);
  bool constants_right() const;
  ConstBytes memory() const { return {ram_ + memory_.address, memory_.bytes}; }
  GdbStub& processor() { return gdb_; }

 private:
  Bytes bytes_of(const Range& range) const { return {ram_ + range.address, range.bytes}; }
  void restore_constants();

  std::string folder_;
  std::function<void()> start_emulator_;
  Range memory_, stack_, log_;
  std::vector<Range> constants_;
  std::vector<Packet> kept_constants_;
  BoardRam shared_;
  std::uint8_t* ram_ = nullptr;
  std::optional<Line> camera_, ground_, rig_;
  GdbStub gdb_;
};

}  // namespace lasso::pil

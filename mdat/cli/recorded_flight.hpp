// A recorded run as options of a simulation: what flies it again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mdat/link/signature.hpp"
#include "mdat/recording/recorded_run.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat {

// Of a recording whose image is not that of its mission (kFlownImage): what was changed, as its metadata say.
constexpr char kFlownImage[] = "image", kAttachedImage[] = "attached";
constexpr char kChangedSettings[] = "changed", kChangedBy[] = "changed_by";

class RecordedFlight {
 public:
  // `key`: file with the key of its commands; empty: there is none. Throws InputError: the recording cannot be read, is not whole, or its
  // commands and `key` do not go together.
  RecordedFlight(const std::string& file, const std::string& key);

  const std::string& file() const { return file_; }
  const RecordedRun& run() const { return run_; }
  const SimulationOptions& options() const { return options_; }  // whose pointers live as long as this

  // Its mission, as it flew; with `more` settings beside those of the run: as it might. Throws MissionError.
  MissionInput mission(const std::vector<std::string>& more = {}) const;
  // Of a what-if that was recorded: settings by which its component differs from the mission's.
  std::vector<std::string> changed_settings() const;
  // Its image, where it is not that of its mission; else empty.
  const std::vector<std::uint8_t>& image() const { return image_; }

  // As many frames as it has telemetry of, given the period of its frames. Throws InputError: of a range that the scenario does not have.
  void limit_to_recorded(const MissionInput& input);
  // How much of a replay's telemetry the recording can be compared with.
  std::size_t comparable_bytes(std::size_t now) const;
  // Whether it says where the target was: a simulated world does, a real sensor's does not.
  bool knows_truth() const;

 private:
  std::vector<Problem> problems_in_recording(const MissionError& error, bool as_flown) const;
  std::string word(const char* key) const;
  std::uint64_t number(const char* key) const;
  std::uint32_t frames_until(double period_s) const;
  void set_commands(const std::string& key);
  void check_signatures(const Key& master);

  std::string file_;
  RecordedRun run_;
  MissionFolder folder_;
  std::unique_ptr<SignatureCheck> signatures_;
  std::vector<std::uint8_t> image_;
  SimulationOptions options_;
};

}  // namespace lasso::mdat

// The two image buffers: one is active, the other one may be loaded, checked, converted and made ready meanwhile, and then takes the place
// of the active one, which stays as it was. What is active is never written to, except to repair it. All of the work goes on a slot at a
// time.
//
// Buffer i goes with image area i of the board's store, if there is one: a checked image is written there as it was received, and selected
// for the next start once it is confirmed (stored_record.hpp). Before that the store's selected image is the one that was confirmed last.
#pragma once

#include "fsw/core/time.hpp"
#include "fsw/core/voted.hpp"
#include "fsw/mission/image_slot.hpp"
#include "fsw/mission/load_map.hpp"
#include "fsw/mission/scrub.hpp"
#include "fsw/mission/store.hpp"

namespace lasso {

constexpr std::uint32_t kImageWordsPerSlot = 2048;  // of check, conversion, sealing: at most 0.3 million instructions of a 603e
constexpr DurationUs kScrubPeriod_us = 8'000'000;   // of one pass; the requirement says 10 s, and a finding may have to wait for a boundary

enum class ImageRefusal : std::uint8_t {
  kNone = 0,
  kNoBuffer = 1,     // the board has given no second buffer
  kTooLong = 2,      // longer than the buffer, or than a part may be
  kNotOpen = 3,      // no image is being loaded
  kOutside = 4,      // of the image that is being loaded; of the area
  kNotWhole = 5,     // a part that does not begin, or end, where a block does
  kIncomplete = 6,   // parts are missing
  kBusy = 7,         // the other buffer is at work, or may still be wanted back
  kNotReady = 8,     // the other buffer has no image that could be active
  kOtherImage = 9,   // it is not the one that is named
  kDoesNotFit = 10,  // its filter.period_s is not that of the active image
  kNotAllowed = 11,  // the area may not be written to
  kSearching = 13,   // a search is under way, with the tables of the active image
};

// Something in memory was not what it should be.
struct MemoryFinding {
  ScrubArea area = ScrubArea::kImage0;
  std::uint32_t chunk = 0;
  bool repaired = false;
};

class ImageKeeper {
 public:
  // Before the first image. The buffers are of one size, aligned to 8 bytes, and share no byte (kBadValue), and belong to the keeper
  // from now on.
  Status use_buffers(Bytes first, Bytes second);
  void use_store(Store& store) { store_ = &store; }
  // Parameters that were changed in flight; it outlives the keeper. What changes there holds from apply_parameters() on.
  void use_parameters(const ParameterArea& changed);
  // See ImageSlot.
  void use_authenticator(Authenticator& authenticator);
  void accept_unsigned();
  // At a boundary, while nobody uses the active image.
  void apply_parameters() { slots_[active_index()].make_views(); }
  // Code that must not change. kOverCapacity. Loop bound: its bytes.
  Status watch_code(ConstBytes code);

  // The first image, at once: all of it, or one of the store's, the one that was selected last if it is right. kNoData: the store has none.
  // `image` begins where one of the buffers does, and ends before the other; or it is anywhere outside of the second (kBadValue).
  LoadFailure start(Bytes image, std::size_t sensors);
  LoadFailure start_stored(std::size_t sensors);
  bool started() const { return started_; }

  const MissionView& view(SensorNumber sensor) const { return slots_[active_index()].view(sensor); }
  const ImageSlot& active() const { return slots_[active_index()]; }
  const ImageSlot& other() const { return slots_[1 - active_index()]; }
  std::uint8_t active_number() const { return static_cast<std::uint8_t>(active_index()); }
  ConstBytes code() const { return code_; }

  // An image of so many bytes, its signature included, with this CRC-32C (its last four bytes before that) is to come into the other
  // buffer. What has come of the same image stays; of another one it is forgotten.
  ImageRefusal open(std::uint32_t bytes, std::uint32_t crc);
  // A part of it: whole blocks, or up to the end of the image.
  ImageRefusal put(std::uint32_t offset, ConstBytes part);
  // Everything has come: it is checked, stored and made ready, slot by slot.
  ImageRefusal begin_check();
  // Whether the other image, of this CRC, can be made active.
  ImageRefusal can_activate(std::uint32_t crc) const;
  // The image that was active before can be again.
  ImageRefusal can_roll_back() const;
  // At a boundary, while nobody uses the active one. The other image can be made active.
  void swap();
  // The active image has shown its worth: it is the one to start with from now on.
  void confirm();
  // At a boundary, before anybody uses the active one: which one it is lies in copies, and that it is ready is known. False: a bit of that
  // was flipped, and is put right.
  bool keep_selection();

  // One slot's share of the work on the other image.
  void step(std::size_t sensors);
  // One slot's share of the scrub, of slots of this length. True: something was found, which repair() answers.
  bool scrub(DurationUs slot_us);
  // At a boundary, while nobody uses the active image. What cannot be repaired is reported again in each pass.
  MemoryFinding repair();
  bool found() const { return scrub_.found(); }

  bool confirmed() const { return confirmed_; }

  const LoadMap& map() const { return map_; }
  std::uint32_t opened_crc() const { return crc_; }
  bool other_stored() const { return stored_[1 - active_index()]; }
  bool active_stored() const { return stored_[active_index()]; }
  const Scrub& scrub_state() const { return scrub_; }
  DurationUs scrub_pass_us() const { return pass_us_; }  // of the last whole pass

 private:
  static constexpr std::size_t kMaxCodeChunks = 256;
  // Which image is active, 0 or 1, at any time: by the copies, or by the number itself where no two of them agree.
  std::size_t active_index() const {
    auto voted = static_cast<std::uint32_t>(active_);
    static_cast<void>(selected_.get(voted));
    return voted % 2;
  }
  void select(std::size_t number);
  bool other_fits() const;
  ImageSlot& spare() { return slots_[1 - active_index()]; }
  bool start_from(std::size_t number, std::size_t sensors);
  bool may_store(std::size_t number) const;
  void store_slice(std::size_t number);
  void end_storing(std::size_t number, bool stored);
  void take_places(ScrubPlace (&places)[kScrubAreas]) const;
  bool repair_image(std::size_t number, std::uint32_t chunk);
  bool rewrite(std::size_t number, std::uint32_t chunk, bool write, std::uint32_t& sum);
  static StoreArea area_of(std::size_t slot) { return static_cast<StoreArea>(slot); }

  ImageSlot slots_[2];
  std::size_t active_ = 0;
  Voted<std::uint32_t> selected_{0};  // the same: a flip must not make the other image the active one, nor lead out of slots_
  bool started_ = false;
  bool before_ = false;    // the other image was active before
  bool confirmed_ = true;  // the active image
  LoadMap map_;
  std::uint32_t crc_ = 0;  // of the image that is being loaded
  Store* store_ = nullptr;
  bool stored_[2] = {};                // the slot's image is in its area
  std::uint32_t stored_sums_[2] = {};  // CRC-32C of all its bytes as received
  std::size_t stored_bytes_ = 0;       // of the image that is being stored
  Scrub scrub_;
  DurationUs pass_us_ = 0, since_pass_us_ = 0;
  ConstBytes code_;
  std::uint32_t code_sums_[kMaxCodeChunks] = {};
};

}  // namespace lasso

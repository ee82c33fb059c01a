// Signed commands and images, as a board may ask for (fsw/core/authenticator.hpp), by keys of key.hpp.
//
// A command's trailer: a number that has to grow (8 bytes, big-endian), then the first 16 bytes of the HMAC over all bytes before them, the
// packet's and the number's. An image's signature: the 32 bytes of the HMAC, by the image key, over all bytes before them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fsw/core/authenticator.hpp"
#include "mdat/link/key.hpp"

namespace lasso::mdat {

// Gives commands the trailer. Numbers are microseconds since 1970, so that they grow from one program to the next, and from one key to the
// next.
class Signer {
 public:
  explicit Signer(Key key) : key_(std::move(key)) {}
  // A whole packet without a trailer becomes one with it.
  std::vector<std::uint8_t> sign(const std::vector<std::uint8_t>& packet);

 private:
  Key key_;
  std::uint64_t number_ = 0;
};

std::uint64_t number_of_now();

// An image, signed before or not, with the signature of the master. Throws InputError where the key is a derived one, which signs commands
// alone.
std::vector<std::uint8_t> sign_image(const std::vector<std::uint8_t>& image, const Key& master);
bool is_signed_by(const std::vector<std::uint8_t>& image, const Key& master);

// What of the component's end outlives a restart.
struct SignatureState {
  std::uint32_t key = 0;     // number of the key in use
  std::uint64_t number = 0;  // of the last command that was authentic
};

// The component's end, which has the master.
class SignatureCheck final : public Authenticator {
 public:
  using Keep = std::function<bool(const SignatureState&)>;
  // `keep` is called with each state that a restart has to begin with, and says whether it is kept; it may be empty: nothing outlives a
  // restart then.
  explicit SignatureCheck(Key master, const SignatureState& state = {}, Keep keep = {});
  std::size_t trailer_bytes() const override;
  bool authentic(ConstBytes packet, ConstBytes trailer) override;
  std::size_t image_signature_bytes() const override;
  void begin_image() override;
  void take_image(ConstBytes piece) override;
  bool image_authentic(ConstBytes signature) override;
  bool try_key(std::uint32_t number) override;
  bool by_key_on_trial() const override { return by_trial_; }
  bool end_key_trial(bool kept) override;

 private:
  bool is_by(const Key& key, ConstBytes packet, ConstBytes trailer) const;
  bool keep(std::uint32_t key) const;

  Key master_, key_;
  std::optional<Key> trial_;
  bool by_trial_ = false;
  std::uint64_t number_ = 0;
  Keep keep_;
  std::optional<KeyedHash> image_;
};

// The file `authentication` of a board's store: the state, as text. Without one: key 0, and number 0. Throws InputError where it cannot be
// read.
SignatureState load_signature_state(const std::string& store);
void save_signature_state(const std::string& store, const SignatureState& state);

// Of a run that begins now: its store's. Without a store (empty), or with one that no run with a key had, number is the time, so that what
// was recorded before is refused; but a link that is a file has commands that were written before.
SignatureState state_at_start(const std::string& store, const std::string& link);
// Into that store, which is there; without one nothing is kept. Throws InputError where it cannot be written. What cannot be written later
// is told as a warning, once: commands go on, but no further key is confirmed.
SignatureCheck::Keep keep_in(const std::string& store);

}  // namespace lasso::mdat

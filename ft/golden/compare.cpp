// golden_compare A B: are two files of telemetry the same bytes? If not, says the first packet, byte and item that differ.
// Exit codes: 0 the same, 1 different, 2 usage or unreadable files.
#include <algorithm>
#include <cstdio>
#include <string>

#include "fsw/link/dictionary.hpp"
#include "fsw/link/packet.hpp"
#include "ft/golden/files.hpp"

namespace lasso::golden {
namespace {

struct Place {
  std::size_t packet = 0;
  std::size_t byte = 0;  // within the packet
};

// Of byte `at` of the stream.
Place place_of(ConstBytes stream, std::size_t at) {
  Place place;
  place.byte = at;
  while (true) {
    const std::size_t begin = at - place.byte;
    const std::size_t size = packet_size(stream.subspan(begin, stream.size() - begin));
    if (size == 0 || place.byte < size) return place;
    place.byte -= size;
    ++place.packet;
  }
}

std::string item_at(std::size_t byte) {
  const PacketRow& pose = kPackets[0];
  if (byte < item_offset(pose, 0)) return "header";
  for (std::size_t i = 0; i < pose.items.size(); ++i) {
    if (byte < item_offset(pose, i + 1)) return pose.items[i].name;
  }
  return "checksum";
}

int compare(ConstBytes a, ConstBytes b) {
  const std::size_t common = std::min(a.size(), b.size());
  const std::size_t at = static_cast<std::size_t>(std::mismatch(a.begin(), a.begin() + common, b.begin()).first - a.begin());
  if (at == common && a.size() == b.size()) return 0;
  if (at == common) {
    std::printf("equal as far as both go, but %zu and %zu bytes long\n", a.size(), b.size());
    return 1;
  }
  const Place place = place_of(a, at);
  std::printf("first difference: packet %zu, byte %zu (%s): %02X and %02X\n", place.packet, place.byte, item_at(place.byte).c_str(), a[at],
              b[at]);
  return 1;
}

int run(int argc, char** argv) {
  File a, b;
  if (argc != 3 || !read_file(argv[1], a) || !read_file(argv[2], b)) {
    std::fprintf(stderr, "golden_compare: two readable files are needed\n");
    return 2;
  }
  return compare(a.bytes(), b.bytes());
}

}  // namespace
}  // namespace lasso::golden

int main(int argc, char** argv) { return lasso::golden::run(argc, argv); }

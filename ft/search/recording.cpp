#include "ft/search/recording.hpp"

#include <algorithm>

#include "ft/golden/trace.hpp"
#include "mdat/common/output.hpp"

namespace lasso::search {

void Recording::add(const RangeImage& scan) {
  std::vector<std::uint8_t> buffer(golden::kMaxCallBytes);
  for (std::size_t first = 0; first < scan.samples.size(); first += kMaxSamplesPerPoll) {
    const std::size_t count = std::min(kMaxSamplesPerPoll, scan.samples.size() - first);
    ByteWriter out(Bytes(buffer.data(), buffer.size()));
    golden::put_answer(out, {Status::kOk, count, first + count == scan.samples.size()}, {scan.samples.begin() + first, count});
    scans_.append(out.written().begin(), out.written().end());
  }
}

void Recording::write(const std::filesystem::path& folder, const std::vector<std::uint8_t>& image) const {
  mdat::OutputFolder out(folder);
  out.write("image.3dli", {reinterpret_cast<const char*>(image.data()), image.size()});
  out.write("scans.bin", scans_);
  out.commit();
}

}  // namespace lasso::search

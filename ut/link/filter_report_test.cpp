#include "fsw/link/filter_report.hpp"

#include "fsw/link/filter_rows.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::Stream;

TEST(FilterReport, LiesOnTheWireAsItsRowsSay) {
  VERIFIES("LASSO-LNK-039~1 LASSO-LNK-002~1");
  FilterTelemetry filter;
  filter.scan_id = 0x01020304;
  filter.t_us = 0x1122334455667788;
  filter.started = 1;
  filter.accepted = 5;
  filter.rejected = 6;
  for (std::size_t i = 0; i < kFilterCovarianceTerms; ++i) filter.covariance[i] = static_cast<float>(i) + 0.5F;
  for (std::size_t i = 0; i < kCommonTerms; ++i) filter.common[i] = -static_cast<float>(i);
  Stream packet(kMaxFilterBytes);
  packet.resize(encode_filter(filter, PacketHeader{}, Bytes(packet.data(), packet.size())));
  const Stream data(packet.begin() + kPacketHeaderBytes, packet.end() - kPacketTrailerBytes);
  const Stream head{0, 6, 1, 2, 3, 4, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88, 1, 0, 0, 0, 5, 0, 0, 0, 6};
  ASSERT_EQ(data.size(), head.size() + 4 * (kFilterCovarianceTerms + kCommonTerms));
  EXPECT_EQ(Stream(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(head.size())), head);
  FilterTelemetry read;
  ByteReader in(ConstBytes(data.data(), data.size()));
  in.u16();
  codec_of(filter_rows::kRows).read(in, read);
  for (std::size_t i = 0; i < kFilterCovarianceTerms; ++i) EXPECT_EQ(read.covariance[i], filter.covariance[i]) << i;
  for (std::size_t i = 0; i < kCommonTerms; ++i) EXPECT_EQ(read.common[i], filter.common[i]) << i;
  const std::size_t size = packet.size();
  EXPECT_EQ(encode_filter(filter, PacketHeader{}, Bytes(packet.data(), size - 1)), 0u);
}

}  // namespace
}  // namespace lasso

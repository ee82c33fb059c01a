#include <array>
#include <memory>

#include "bsp/bare/head.hpp"
#include "bsp/bare/ram_store.hpp"
#include "fsw/exec/link_pump.hpp"
#include "fsw/exec/start_image.hpp"
#include "ft/pil/boards.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"

namespace lasso::pil {
namespace {

void expect(Status status, const char* what) {
  if (status != Status::kOk) throw mdat::RunError(std::string("the component refused to ") + what + ": " + to_string(status));
}

class MemoryLink final : public ByteLink {
 public:
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override {
    const std::size_t count = std::min(out.size(), waiting.size());
    std::copy_n(waiting.begin(), count, out.begin());
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  std::size_t write(ConstBytes packets) override {
    said.insert(said.end(), packets.begin(), packets.end());
    return packets.size();
  }
  Packet waiting, said;
};

// The component, wired as on the target.
struct Host {
  Host(const std::vector<std::uint8_t>& bytes, std::size_t code_bytes, Head head)
      : buffers{std::vector<std::uint64_t>(bytes.size() / 8 + 1), std::vector<std::uint64_t>(bytes.size() / 8 + 1)},
        region(bare::RamStore::region_bytes(bytes.size())),
        store({region.data(), region.size()}, bytes.size(), [](ConstBytes) {}),
        code(code_bytes),
        component(std::make_unique<Component>(sensor(head))) {
    BoardMemory memory;
    for (std::size_t i = 0; i < 2; ++i) memory.image_buffers[i] = mdat::view(buffers[i], bytes.size());
    memory.store = &store;
    memory.code = ConstBytes(code.data(), code.size());
    expect(start_image(*component, memory, {bytes.data(), bytes.size()}).failure.status, "load its image");
    expect(component->begin(mdat::kEpochUs), "begin");
  }

  Sensor& sensor(Head head) {
    if (head == Head::kAtLine) return line_driver;
    return head_driver;
  }

  void meet(World& world, std::uint32_t slot) {
    Packet bytes(lcs::kLineBytes);
    bytes.resize(line.to_camera.read(Bytes(bytes.data(), bytes.size())));
    world.move_to(slot, {bytes.data(), bytes.size()});
    const Packet camera = world.from_camera(), ground = world.from_ground();
    static_cast<void>(line.from_camera.write({camera.data(), camera.size()}));
    link.waiting.insert(link.waiting.end(), ground.begin(), ground.end());
  }

  void run_slot() {
    const TimeUs now_us = component->next_slot_us();
    pump.receive(now_us);
    component->run_slot(now_us);
    component->run_estimation();
    if (component->next_slot_is_boundary()) {
      Packet packets(kTelemetryQueueBytes);
      packets.resize(component->take_telemetry(Bytes(packets.data(), packets.size())));
      static_cast<void>(link.write({packets.data(), packets.size()}));
    }
  }

  std::array<std::vector<std::uint64_t>, 2> buffers;
  std::vector<std::uint8_t> region;
  bare::RamStore store;
  std::vector<std::uint8_t> code;  // as much as the target has: the scrub's pass takes as long
  lcs::Line line;
  lcs::Driver line_driver{line, lcs::Optics(bare::design_calibration())};
  lcs::HeadMemory head_memory;
  lcs::HeadDriver head_driver{head_memory, lcs::Optics(bare::design_calibration())};
  std::unique_ptr<Component> component;
  MemoryLink link;
  LinkPump pump{*component, link};
};

}  // namespace

Packet fly_on_host(const WorldSetup& setup, const HostMemory& memory, Head head, std::uint32_t frames, const Told& told) {
  Host host(memory.image, memory.code_bytes, head);
  World world(setup, head == Head::kAtLine ? nullptr : &host.head_memory);
  for (std::uint32_t slot = 0; slot < frames * kSlotsPerFrame; ++slot) {
    host.meet(world, slot);
    host.run_slot();
    told((slot + 1) / kSlotsPerFrame);
  }
  return host.link.said;
}

}  // namespace lasso::pil

#include <drivers/gic.h>

namespace drivers {
namespace {

constexpr std::uint32_t cpu_interface(std::uint32_t offset) {
  return gic::cpu_interface_base + offset;
}
constexpr std::uint32_t distributor(std::uint32_t offset) {
  return gic::distributor_base + offset;
}
constexpr std::uint32_t in_all_bytes(std::uint32_t byte) {
  return byte * 0x0101'0101u;
}

void set_trigger(std::uint32_t id, Trigger trigger) {
  const std::uint32_t address = distributor(gic::ICDICFR(id / 16));
  const unsigned shift = id % 16 * 2;
  const std::uint32_t value =
      trigger == Trigger::rising_edge ? gic::icdicfr::rising_edge : gic::icdicfr::level_high;
  hal_write32(address, (hal_read32(address) & ~(3u << shift)) | value << shift);
}

}  // namespace

void Gic::initialise() {
  handlers_ = {};
  unhandled_ = 0;
  hal_write32(distributor(gic::ICDDCR), 0);
  for (unsigned n = gic::first_spi / 16; n < gic::sense_registers; ++n) {
    hal_write32(distributor(gic::ICDICFR(n)), 0);
  }
  for (unsigned n = 0; n < gic::byte_registers; ++n) {
    hal_write32(distributor(gic::ICDIPR(n)), in_all_bytes(default_priority));
  }
  for (unsigned n = gic::first_spi / 4; n < gic::byte_registers; ++n) {
    hal_write32(distributor(gic::ICDIPTR(n)), in_all_bytes(1));
  }
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    hal_write32(distributor(gic::ICDICER(n)), 0xFFFF'FFFFu);
  }
  hal_write32(distributor(gic::ICDDCR), gic::icddcr::EnableS);
  open_cpu_interface();
}

void Gic::initialise_second() {
  handlers_ = {};
  unhandled_ = 0;
  for (unsigned n = 0; n < gic::first_spi / 4; ++n) {
    hal_write32(distributor(gic::ICDIPR(n)), in_all_bytes(default_priority));
  }
  hal_write32(distributor(gic::ICDICER(0)), 0xFFFF'FFFFu);
  open_cpu_interface();
}

void Gic::open_cpu_interface() {
  hal_write32(cpu_interface(gic::ICCPMR), priority_mask);
  hal_write32(cpu_interface(gic::ICCICR),
              gic::iccicr::EnableS | gic::iccicr::EnableNS | gic::iccicr::AckCtl);
  hal_interrupt_connect(&Gic::dispatch, this);
}

bool Gic::connect(std::uint32_t id, Trigger trigger, hal_interrupt_handler handler, void* context) {
  if (id >= gic::id_count || handler == nullptr) return false;
  handlers_[id] = {handler, context};
  if (id >= gic::first_spi) set_trigger(id, trigger);
  hal_write32(distributor(gic::ICDISER(id / 32)), 1u << id % 32);
  return true;
}

void Gic::raise(std::uint32_t id, std::uint32_t cpus) {
  hal_barrier();
  hal_write32(distributor(gic::ICDSGIR),
              cpus << gic::icdsgir::CPUTargetList_shift | (id & gic::icdsgir::SGIINTID));
}

void Gic::disconnect(std::uint32_t id) {
  if (id >= gic::id_count) return;
  hal_write32(distributor(gic::ICDICER(id / 32)), 1u << id % 32);
  handlers_[id] = {};
}

void Gic::dispatch(void* self) {
  Gic& controller = *static_cast<Gic*>(self);
  const std::uint32_t acknowledged = hal_read32(cpu_interface(gic::ICCIAR));
  const std::uint32_t id = acknowledged & gic::icciar::ACKINTID;
  if (id >= gic::id_count) return;  // spurious: there is nothing to end
  const Entry& entry = controller.handlers_[id];
  if (entry.handler != nullptr) {
    entry.handler(entry.context);
  } else {
    ++controller.unhandled_;
  }
  hal_write32(cpu_interface(gic::ICCEOIR), acknowledged);
}

}  // namespace drivers

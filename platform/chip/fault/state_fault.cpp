#include <cstdint>
#include <cstring>
#include <optional>

#include <chip/fault/injector.h>
#include <chip/fault/places.h>
#include <vp/clock.h>
#include <vp/gated_clock.h>
#include <vp/mm_link.h>
#include <vp/probe.h>
#include <vp/register_bank.h>
#include <vp/unit.h>
#include <xilinx/bram/bram.h>

namespace platform {

namespace {

void check_bit(const Fault& fault, unsigned bits) {
  if (fault.bit >= bits)
    throw vp::InputError("'bit' is " + std::to_string(fault.bit) + ", and there are " +
                         std::to_string(bits) + ": count from 0");
}

/// The word that the processor finds at an address changes, without the effects of a write.
void plan_flip_at_address(Injector& injector, Injection& injection) {
  check_bit(injection.fault, word_bits);
  const auto address = static_cast<std::uint32_t>(injection.fault.address);
  if (injection.fault.address != address || address % 4 != 0)
    throw vp::InputError("'address' is that of a word: a multiple of 4, below 0x100000000");
  const Zynq& zynq = injector.zynq();
  if (!zynq.ps.ddr.contains(address, sizeof address) && zynq.device_at(address).empty())
    throw vp::InputError("no memory and no register answers at " + vp::hex(address) +
                         ": 'markervp map' lists them");
  injector.plan(injection.fault.at_ps, [&injector, &injection, address] {
    Zynq& now = injector.zynq();
    const std::optional<std::uint32_t> word = now.peek(address);
    if (!word) return;
    now.poke(address, *word ^ std::uint32_t{1} << injection.fault.bit);
    if (now.peek(address) != word) injection.happened(now.scheduler.now_ps());
  });
}

void plan_flip_in(Injector& injector, Injection& injection, xilinx::Bram& memory) {
  const Fault& fault = injection.fault;
  if (!fault.has_address || fault.address >= memory.size_b())
    throw vp::InputError(std::string("'address' is a byte of ") + memory.name() + ", 0 to " +
                         std::to_string(memory.size_b() - 1));
  check_bit(fault, 8);
  injector.plan(fault.at_ps, [&injector, &injection, &memory] {
    memory.settle();
    std::vector<std::uint8_t> bytes = memory.contents();
    bytes[injection.fault.address] ^= static_cast<std::uint8_t>(1U << injection.fault.bit);
    memory.load(bytes);
    injection.happened(injector.zynq().scheduler.now_ps());
  });
}

void plan_flip_of(Injector& injector, Injection& injection, vp::Register& target) {
  check_bit(injection.fault, word_bits);
  injector.plan(injection.fault.at_ps, [&injector, &injection, &target] {
    target.set(target.value() ^ std::uint32_t{1} << injection.fault.bit);
    injection.happened(injector.zynq().scheduler.now_ps());
  });
}

/// A register inside of the logic, which a trace would show.
void plan_flip_of(Injector& injector, Injection& injection, vp::ProbeBase& probe) {
  check_bit(injection.fault, probe.width());
  check_played(injector, probe.name());
  if (!probe.address())
    throw vp::InputError(std::string(probe.name()) +
                         " is computed, not stored: name a register that it follows from");
  injector.plan(injection.fault.at_ps, [&injector, &injection, &probe] {
    // Probes show registers of models; a fault is what changes one from outside.
    auto* bytes = static_cast<unsigned char*>(const_cast<void*>(probe.address()));
    bytes[injection.fault.bit / 8] ^= static_cast<unsigned char>(1U << injection.fault.bit % 8);
    if (vp::Clocked* module = probe.writer()) module->wake();
    injection.happened(injector.zynq().scheduler.now_ps());
  });
}

/// "pl.axi_dma.s_axi_lite.MM2S_DMACR": a register of a bank; null: it names none.
vp::Register* register_named(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return nullptr;
  auto* bank =
      dynamic_cast<vp::RegisterBank*>(sc_core::sc_find_object(path.substr(0, dot).c_str()));
  if (!bank) return nullptr;
  std::vector<std::string> names;
  for (const vp::Register& one : bank->registers()) {
    if (one.info().name == path.substr(dot + 1)) return &(*bank)[one.info().offset];
    names.push_back(one.info().name);
  }
  const std::string nearest = vp::nearest_match(path.substr(dot + 1), names);
  throw vp::InputError(std::string(bank->name()) + " has no register '" + path.substr(dot + 1) +
                       "'" + (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

}  // namespace

void plan_flip(Injector& injector, Injection& injection) {
  const std::string& where = injection.fault.where;
  if (where.empty()) return plan_flip_at_address(injector, injection);
  sc_core::sc_object* const object = sc_core::sc_find_object(where.c_str());
  if (auto* memory = dynamic_cast<xilinx::Bram*>(object))
    return plan_flip_in(injector, injection, *memory);
  if (injection.fault.has_address)
    throw vp::InputError("'address' is a byte of a memory: leave it out for '" + where + "'");
  if (vp::Register* target = register_named(where))
    return plan_flip_of(injector, injection, *target);
  plan_flip_of(injector, injection,
               place_named<vp::ProbeBase>(where,
                                          "a memory, a register of a device (BANK.NAME) or "
                                          "of the logic at this fidelity"));
}

void plan_clock_fault(Injector& injector, Injection& injection) {
  vp::Clock& clock = place_named<vp::Clock>(injection.fault.where, "a clock");
  const Fault& fault = injection.fault;
  if (dynamic_cast<vp::GatedClock*>(&clock))
    throw vp::InputError(std::string(clock.name()) + " follows " + clock.source().name() +
                         ": name that");
  injector.plan(fault.at_ps, [&injector, &injection, &clock] {
    clock.set_frequency(injection.fault.value);
    injection.happened(injector.zynq().scheduler.now_ps());
  });
}

}  // namespace platform

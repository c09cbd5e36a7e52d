#include <chip/system/zynq.h>

#include <cstring>
#include <utility>

#include <axi/rtl_part.h>
#include <chip/handoff/register_file.h>
#include <chip/system/hardware_map.h>
#include <chip/system/ps_blocks.h>
#include <chip/system/wait_reason.h>
#include <gic_registers.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

namespace {

/// Parts outside of `pl` would not be found.
void check_that_parts_are_inside() {
  for (const sc_core::sc_object* object : sc_core::sc_get_top_level_objects()) {
    if (!dynamic_cast<const vp::Ip*>(object)) continue;
    throw vp::InputError(std::string("the part '") + object->name() +
                         "' is outside of 'pl': let the constructor of the design take its "
                         "name as sc_core::sc_module_name");
  }
}

void check_that_parts_are_reached(const vp::Router* registers, const std::string& port,
                                  std::uint64_t first, const sc_core::sc_module& pl) {
  if (!registers) return;
  const std::uint64_t last = first + ProcessingSystem::gp0_size - 1;
  for (const vp::Router::Region& region : registers->regions()) {
    if (first <= region.base && region.last() <= last) continue;
    const std::string part = std::string(pl.name()) + "." + region.name;
    const bool is_set = sc_core::sc_find_object((part + ".base_address").c_str()) != nullptr;
    throw vp::InputError(part + " is at " + vp::hex(region.base) + " to " + vp::hex(region.last()) +
                         ", but " + port + " reaches " + vp::hex(first) + " to " + vp::hex(last) +
                         ": " + (is_set ? "set " + part + ".base_address" : "map it") +
                         " to a place there");
  }
}

/// Messages of a run need what describes the registers of RTL: what cannot be read of it is refused
/// before the run, not in it.
void check_descriptions_of_registers(const sc_core::sc_module& pl) {
  for (const auto* part : vp::all_below<axi::RtlPart>(pl)) {
    if (const std::string file = part->registers_file(); !file.empty())
      handoff::read_registers(file);
  }
}

}  // namespace

Zynq::Zynq(const DesignInfo& design, pl::Fidelity otherwise, std::uint32_t usual_cores)
    : fidelity("fidelity", otherwise,
               {{"tlm", pl::Fidelity::tlm}, {"clocked", pl::Fidelity::clocked}},
               vp::Source::decision,
               "how the programmable logic is modelled, if pl.fidelity names nothing else for an "
               "IP: whole frames, or clock by clock; the results are the same"),
      ps("ps", scheduler, chip, usual_cores),
      design_(design.make("pl", ports)) {
  ports.tie_off();
  check_that_parts_are_inside();
  check_that_parts_are_reached(ports.registers(), "m_axi_gp0", ProcessingSystem::gp0_base, pl());
  check_that_parts_are_reached(ports.registers_gp1(), "m_axi_gp1", ProcessingSystem::gp1_base,
                               pl());
  check_descriptions_of_registers(pl());
  ps.start_clocks();
  scheduler.set_batch(true);
  for (ps::Cpu* core : ps.cpus()) {
    const ps::Gic& gic = core->number() == 0 ? ps.gic : ps.second_core()->gic;
    core->surroundings = {
        [this](std::uint32_t address) { return answerer_at(address); },
        [this](std::uint32_t address, std::uint32_t value) {
          return register_text(hardware_map(*this), address, value);
        },
        [this, &gic] {
          const ps::Gic::Request request = gic.request();
          return ps::Surroundings::Request{request_text(gic, request), request.since_ps};
        },
        [this, &gic](const ps::Surroundings::Wait& wait) {
          return reason_of_wait(*this, gic, wait);
        },
        [&gic] { return gic.logic().any_enabled(); }};
  }
}

std::string Zynq::request_text(const ps::Gic& gic, const ps::Gic::Request& request) {
  if (request.id >= gic::id_count) return {};
  std::string text = "interrupt " + std::to_string(request.id);
  for (const auto& interrupt : hardware_map(*this).interrupts) {
    if (interrupt.id == request.id) text += ", " + interrupt.source;
  }
  const bool edge = gic.logic().edge[request.id];
  const bool held = gic.logic().wire[request.id];
  return text +
         (edge   ? ", an edge at "
          : held ? ", a level held since "
                 : ", raised at ") +
         vp::format_time(request.since_ps);
}

bool Zynq::look(tlm::tlm_command command, std::uint32_t address, std::uint32_t& word) {
  unsigned char bytes[sizeof word];
  std::memcpy(bytes, &word, sizeof word);
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(bytes);
  payload.set_data_length(sizeof bytes);
  payload.set_streaming_width(sizeof bytes);
  const bool answered = ps.cpu.m_axi.transport_debug(payload) == sizeof bytes;
  std::memcpy(&word, bytes, sizeof word);
  return answered;
}

std::optional<std::uint32_t> Zynq::peek(std::uint32_t address) {
  std::uint32_t word = 0;
  if (!look(tlm::TLM_READ_COMMAND, address, word)) return std::nullopt;
  return word;
}

bool Zynq::poke(std::uint32_t address, std::uint32_t word) {
  const bool answered = look(tlm::TLM_WRITE_COMMAND, address, word);
  if (answered && poke_listener_) poke_listener_(address);
  return answered;
}

// The buses have names of their own, which say nothing of what a program wanted there.
ps::Answerer Zynq::answerer_at(std::uint32_t address) const {
  std::string device = device_at(address);
  const bool is_bus = device == "peripheral_bus" || device == "private_bus";
  const PsBlock* block = device.empty() || is_bus ? ps_block_at(address) : nullptr;
  if (block) return {block->name, false};
  return {std::move(device)};
}

std::string Zynq::device_at(std::uint32_t address) const {
  for (const vp::Router* bus : {ports.registers(), ports.registers_gp1(),
                                static_cast<const vp::Router*>(&ps.private_bus.devices),
                                &ps.peripheral_bus.devices, &ps.interconnect}) {
    const vp::Router::Region* region = bus ? bus->find(address) : nullptr;
    if (region) return region->name;
  }
  return {};
}

}  // namespace platform

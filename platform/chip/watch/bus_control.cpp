#include <chip/watch/bus_control.h>

#include <chip/system/hardware_map.h>
#include <chip/watch/bus_log.h>
#include <chip/watch/command_fields.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/text.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace platform {

namespace {

using Json = nlohmann::json;

constexpr std::uint64_t most_memory = 1 << 18;  ///< of a command

/// A name as `map` has it, or a number.
std::uint32_t address(Zynq& zynq, const Json& command) {
  const auto found = command.find("at");
  if (found != command.end() && found->is_string())
    return DeviceNames(hardware_map(zynq)).address_of(found->get<std::string>());
  return static_cast<std::uint32_t>(number_of(command, "at", UINT32_MAX));
}

Json access(Zynq& zynq, const Json& command) {
  const std::uint32_t at = address(zynq, command);
  const bool writes = command.contains("value");
  std::uint32_t word = 0;
  if (writes) word = static_cast<std::uint32_t>(number_of(command, "value", UINT32_MAX));
  std::array<unsigned char, sizeof word> bytes{};
  std::memcpy(bytes.data(), &word, sizeof word);
  tlm::tlm_generic_payload payload;
  payload.set_command(writes ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
  payload.set_address(at);
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(bytes.size());
  payload.set_streaming_width(bytes.size());
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
  zynq.ps.cpu.m_axi.transport(payload, delay);
  sc_core::wait(delay);
  zynq.scheduler.synchronise();
  if (payload.get_response_status() != tlm::TLM_OK_RESPONSE)
    throw vp::InputError("the access to " + vp::hex(at) + " is answered with an error, a data " +
                         "abort on the processor");
  std::memcpy(&word, bytes.data(), sizeof word);
  return {{"value", word}};
}

constexpr const char* digit_of = "0123456789abcdef";

unsigned nibble(char digit) {
  if (digit >= '0' && digit <= '9') return static_cast<unsigned>(digit - '0');
  if (digit >= 'a' && digit <= 'f') return static_cast<unsigned>(digit - 'a') + 10;
  throw vp::InputError("'hex' must be digits 0 to 9 and a to f");
}

Json memory(Zynq& zynq, const Json& command) {
  const auto hex = command.find("hex");
  const bool writes = hex != command.end() && hex->is_string();
  const std::string digits = writes ? hex->get<std::string>() : "";
  const std::uint64_t bytes = writes ? digits.size() / 2 : number_of(command, "bytes", most_memory);
  const std::uint64_t at = address(zynq, command);
  if (at < ps::Ddr::base || at + bytes > zynq.ps.ddr.end() || digits.size() % 2 != 0)
    throw vp::InputError(vp::hex(at) + ": " + std::to_string(bytes) +
                         " bytes do not lie in the DDR");
  unsigned char* place = zynq.ps.ddr.behind(static_cast<std::uint32_t>(at), bytes);
  for (std::size_t i = 0; i < digits.size() / 2; ++i) {
    place[i] = static_cast<unsigned char>(nibble(digits[2 * i]) << 4 | nibble(digits[2 * i + 1]));
  }
  if (writes) return Json::object();
  std::string text;
  for (std::uint64_t i = 0; i < bytes; ++i) {
    text += digit_of[place[i] >> 4];
    text += digit_of[place[i] & 0xF];
  }
  return {{"hex", text}};
}

/// By name: its offset, and of each field the lowest bit and how many.
Json registers_of(const facts::HardwareMap::Device& device) {
  Json registers = Json::object();
  for (const auto& one : device.registers) {
    Json fields = Json::object();
    for (const auto& field : one.fields) {
      unsigned low = 0, bits = 0;
      while ((field.mask >> low & 1) == 0 && low < 31) ++low;
      while (low + bits < 32 && (field.mask >> (low + bits) & 1) != 0) ++bits;
      fields[field.name] = {low, bits};
    }
    registers[one.name] = {{"offset", one.offset}, {"fields", fields}};
  }
  return registers;
}

Json devices(Zynq& zynq) {
  Json list = Json::array();
  const facts::HardwareMap map = hardware_map(zynq);
  for (const auto& device : map.devices) {
    if (device.way.rfind("m_axi_gp", 0) != 0) continue;
    list.push_back({{"name", device.name},
                    {"base", device.base},
                    {"size", device.size},
                    {"what", device.what},
                    {"path", device.path},
                    {"registers", registers_of(device)}});
  }
  Json interrupts = Json::object(), clocks = Json::object();
  for (const auto& interrupt : map.interrupts) interrupts[interrupt.source] = interrupt.id;
  for (const auto& clock : map.clocks) clocks[clock.name] = clock.hertz;
  Json settings = Json::object();
  for (const auto* parameter : vp::all_below<vp::ParameterBase>(zynq.pl()))
    settings[parameter->name()] = parameter->text();
  return {
      {"devices", list}, {"settings", settings}, {"interrupts", interrupts}, {"clocks", clocks}};
}

}  // namespace

bool is_for_the_bus(const std::string& what) {
  return what == "access" || what == "memory" || what == "devices";
}

Json obey_for_the_bus(Zynq& zynq, const std::string& what, const Json& command) {
  if (what == "access") return access(zynq, command);
  zynq.settle();
  return what == "memory" ? memory(zynq, command) : devices(zynq);
}

}  // namespace platform

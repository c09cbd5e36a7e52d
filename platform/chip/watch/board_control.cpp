#include <chip/watch/board_control.h>
#include <chip/watch/command_fields.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include <board/hosts.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>

namespace platform {

namespace {

using Json = nlohmann::json;

constexpr std::uint64_t largest_device = 1 << 20;  ///< bytes

/// The module `name` that is a T; `what` is it in words.
template <class T>
T& module_named(const std::string& name, const std::string& what) {
  if (auto* found = dynamic_cast<T*>(sc_core::sc_find_object(name.c_str()))) return *found;
  std::string choice;
  for (sc_core::sc_object* object : vp::all_objects<sc_core::sc_module>()) {
    if (dynamic_cast<T*>(object))
      choice += (choice.empty() ? "" : ", ") + std::string(object->name());
  }
  throw vp::InputError("no " + what + " '" + vp::excerpt(name) + "': choose " + choice);
}

Json pin(ProcessingSystem& ps, const Json& command) {
  constexpr std::uint64_t last = 117;
  const auto pin = static_cast<unsigned>(number_of(command, "number", last));
  if (command.contains("level")) ps.gpio.set_pin(pin, number_of(command, "level", 1) != 0);
  if (command.contains("released")) ps.gpio.release_pin(pin);
  if (command.contains("wire_to"))
    ps.gpio.connect_pins(pin, static_cast<unsigned>(number_of(command, "wire_to", last)));
  return {{"level", ps.gpio.pin(pin)}};
}

std::unique_ptr<board::I2cDevice> i2c_device(const std::string& device, const Json& command) {
  if (device == "eeprom")
    return std::make_unique<board::I2cEeprom>(number_of(command, "size", largest_device, 256),
                                              number_of(command, "page", largest_device, 16));
  if (device == "registers")
    return std::make_unique<board::I2cRegisterFile>(
        static_cast<unsigned>(number_of(command, "index_bytes", 2, 1)),
        static_cast<unsigned>(number_of(command, "value_bytes", 2, 1)));
  throw vp::InputError("no I2C device '" + vp::excerpt(device) + "': choose eeprom or registers");
}

Json attach(const Json& command) {
  const std::string bus = text_of(command, "bus"), device = text_of(command, "device");
  if (device == "flash") {
    const auto slave = static_cast<unsigned>(number_of(command, "slave", 31, 0));
    const auto size = number_of(command, "size", 64u << 20, board::SpiFlash::usual_size);
    module_named<board::SpiHost>(bus, "SPI controller")
        .attach(slave, std::make_shared<board::SpiFlash>(size));
    return Json::object();
  }
  auto made = i2c_device(device, command);
  module_named<board::I2cHost>(bus, "I2C controller")
      .i2c_bus()
      .attach(static_cast<unsigned>(number_of(command, "address", 0x7F)), std::move(made));
  return Json::object();
}

Json contents(const Json& command) {
  board::I2cBus& bus =
      module_named<board::I2cHost>(text_of(command, "bus"), "I2C controller").i2c_bus();
  const auto address = static_cast<unsigned>(number_of(command, "address", 0x7F));
  board::I2cDevice* device = bus.find(address);
  if (!device) throw vp::InputError("no device at I2C address " + std::to_string(address));
  const std::uint64_t at = number_of(command, "at", largest_device);
  Json bytes = Json::array();
  if (const auto given = command.find("bytes"); given != command.end()) {
    std::uint64_t place = at;
    for (const Json& byte : *given) device->poke(place++, byte.get<std::uint8_t>());
    return Json::object();
  }
  const std::uint64_t count = number_of(command, "count", largest_device);
  for (std::uint64_t i = 0; i < count; ++i) bytes.push_back(device->peek(at + i));
  return {{"bytes", bytes}};
}

// "uart0" is short for "ps.uart0".
Json receive(const Json& command) {
  const std::string device = text_of(command, "device");
  const bool is_short = device.find('.') == std::string::npos;
  module_named<board::SerialHost>((is_short ? "ps." : "") + device, "serial line")
      .receive(text_of(command, "text"));
  return Json::object();
}

Json analogue(const Json& command) {
  const auto value = command.find("value");
  if (value == command.end() || !value->is_number())
    throw vp::InputError("needs 'value', a number");
  module_named<board::AnalogueHost>(text_of(command, "name"), "XADC")
      .set_input(static_cast<unsigned>(number_of(command, "channel", 31)), value->get<double>());
  return Json::object();
}

}  // namespace

bool is_for_the_board(const std::string& what) {
  return what == "pin" || what == "attach" || what == "contents" || what == "receive" ||
         what == "analogue";
}

Json obey_for_the_board(Zynq& zynq, const std::string& what, const Json& command) {
  try {
    if (what == "pin") return pin(zynq.ps, command);
    if (what == "attach") return attach(command);
    if (what == "contents") return contents(command);
    if (what == "receive") return receive(command);
    return analogue(command);
  } catch (const std::logic_error& error) {  // of the models: an address or a size
    throw vp::InputError(error.what());
  } catch (const nlohmann::json::exception&) {
    throw vp::InputError("'bytes' must be whole numbers up to 255");
  }
}

}  // namespace platform

// Options: the program's defaults, but for those that the build sets.
#include "chip.h"

#include <hal/hal.h>
#include <hal/option_data.h>

#include <cstring>

namespace chip {
namespace {

bool is_for_this_program(const OptionOverride& entry) {
  return std::strcmp(entry.program, hal_program_info.name) == 0;
}

const hal_option_info* find(const char* name) {
  for (std::uint32_t i = 0; i < hal_program_info.option_count; ++i) {
    if (std::strcmp(hal_program_info.options[i].name, name) == 0)
      return &hal_program_info.options[i];
  }
  return nullptr;
}

[[noreturn]] void refuse(const OptionOverride& entry, const char* reason) {
  print("chip: option ");
  print(entry.program);
  print(".");
  print(entry.option);
  print(reason);
  print("\n");
  end(input_exit_code);
}

}  // namespace

void check_options() {
  for (const OptionOverride* entry = option_overrides; entry->program != nullptr; ++entry) {
    if (!is_for_this_program(*entry)) continue;
    const hal_option_info* info = find(entry->option);
    if (info == nullptr) refuse(*entry, ": the program has no such option");
    if (std::strcmp(info->unit, HAL_UNIT_FILE) == 0)
      refuse(*entry, ": there are no files on the chip");
    if (!(entry->value >= info->minimum && entry->value <= info->maximum)) {
      refuse(*entry, ": the value of MARKERVP_CHIP_OPTIONS is out of range");
    }
  }
}

}  // namespace chip

extern "C" double hal_option(uint32_t option) {
  if (option >= hal_program_info.option_count) {
    chip::print("chip: hal_option(): no such option\n");
    chip::end(chip::fault_exit_code);
  }
  const hal_option_info& info = hal_program_info.options[option];
  double value = info.default_value;
  for (const chip::OptionOverride* entry = chip::option_overrides; entry->program != nullptr;
       ++entry) {
    if (chip::is_for_this_program(*entry) && std::strcmp(entry->option, info.name) == 0) {
      value = entry->value;
    }
  }
  return value;
}

extern "C" const void* hal_option_data(uint32_t, size_t* size) {
  *size = 0;
  return nullptr;
}

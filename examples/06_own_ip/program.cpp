// The thesis' PS program, and what the frame counter counted.
#include <apps/common/message.h>
#include <apps/hybrid/application.h>
#include <marker/work.h>

#include "frame_counter_registers.h"

namespace {

hybrid::Application application;

int run() {
  const std::uint32_t base = hal_xpar("FRAME_COUNTER_BASEADDR", frame_counter::base);
  hal_write32(base + frame_counter::CONTROL, frame_counter::enable);
  const int result = application.run();
  apps::Message().text("frames counted: ").number(hal_read32(base + frame_counter::COUNT)).write();
  return result;
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "counting",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      hybrid::option_table,
                                      hybrid::option_count};

#include <apps/improved/application.h>
#include <marker/work.h>

namespace {

improved::Application application;

int run() {
  return application.run();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "improved",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      improved::option_table,
                                      improved::option_count};

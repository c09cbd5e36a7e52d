#include <apps/hybrid/application.h>
#include <marker/work.h>

namespace {

hybrid::Application application;

int run() {
  return application.run();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "hybrid",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      hybrid::option_table,
                                      hybrid::option_count};

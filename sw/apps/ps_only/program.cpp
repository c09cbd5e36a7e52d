#include <apps/ps_only/application.h>
#include <marker/work.h>

namespace {

ps_only::Application application;

int run() {
  return application.run();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI,
                                      "ps-only",
                                      &run,
                                      marker::work_names,
                                      static_cast<std::uint32_t>(marker::Work::count),
                                      marker::function_names,
                                      static_cast<std::uint32_t>(marker::Function::count),
                                      ps_only::option_table,
                                      ps_only::option_count};

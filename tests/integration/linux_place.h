#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include "executable.h"

namespace integration {

/// Where Linux applications are tried out: the folders for their devices go to "tmp", and must be
/// gone again.
struct LinuxPlace : Workplace {
  LinuxPlace() {
    std::filesystem::create_directory(*this / "tmp");
    ::setenv("TMPDIR", (*this / "tmp").c_str(), 1);
    // A frozen program keeps its memory, which is no leak.
    ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  }
  ~LinuxPlace() {
    BOOST_TEST(await([this] { return std::filesystem::is_empty(*this / "tmp"); }));
    ::unsetenv("TMPDIR");
    ::unsetenv("LSAN_OPTIONS");
  }

  /// What is to come of itself.
  static bool await(const std::function<bool()>& condition) {
    for (int i = 0; i < 6000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }
  /// How many run an application.
  static unsigned processes(const std::string& application) {
    unsigned count = 0;
    for (const auto& process : std::filesystem::directory_iterator("/proc")) {
      std::error_code none;
      const auto file = std::filesystem::read_symlink(process.path() / "exe", none);
      count += file == MARKERVP_APPLICATIONS + application ? 1 : 0;
    }
    return count;
  }
  /// What was killed may take a moment to end.
  static bool none_is_left(const std::string& application) {
    return await([&] { return processes(application) == 0; });
  }
};

}  // namespace integration

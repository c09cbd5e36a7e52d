#pragma once

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <study/shards.h>

#include "executable.h"

namespace sweep_test {

using integration::Json;

constexpr const char* clocks = R"(
parameters:
  ps.fclk_clk1.frequency: {start: 25 MHz, stop: 100 MHz, step: 25 MHz}
metrics: [summary.fps.mean, frames.time_us.frame.mean]
objectives: [max summary.fps.mean, min summary.latency_us.mean]
)";

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void wait_until(const std::function<bool()>& happened) {
  while (!happened()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// A folder in which sweeps run.
class Sweeps : public kit::TemporaryFolder {
 public:
  void write(const std::string& name, const std::string& yaml) const {
    kit::write_file(*this / name, yaml);
  }
  kit::Outcome run(const std::vector<std::string>& arguments) const {
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
  /// With a limit of the shell before it.
  kit::Outcome run_limited(const std::string& limit, const std::string& arguments) const {
    const std::string command = limit + "; exec " + MARKERVP_EXECUTABLE + " " + arguments;
    return kit::run_process("/bin/bash", {"-c", command}, path());
  }
  std::string problem(const std::string& yaml) const {
    write("wrong.yaml", yaml);
    const kit::Outcome outcome = run({"sweep", "wrong.yaml"});
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(!std::filesystem::exists(*this / "out"));
    return outcome.err;
  }
  /// Whole results that are kept, by file.
  std::map<std::string, std::string> kept(const std::string& folder) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(*this / (folder + "/points"))) {
      if (entry.path().extension() == ".json")
        result[entry.path().filename().string()] = kit::read_file(entry.path().string());
    }
    return result;
  }
  std::size_t count_points(const std::string& folder) const {
    std::error_code ignored;
    return std::filesystem::exists(*this / (folder + "/runs"), ignored)
               ? computations(folder).size()
               : 0;
  }
  /// Times that points were computed, by key.
  std::map<std::string, int> computations(const std::string& folder) const {
    std::map<std::string, int> counts;
    const platform::study::Shards shards{platform::study::Store(*this / folder)};
    shards.visit([&](const platform::study::Computation& found) { ++counts[found.key]; });
    return counts;
  }
  /// The first by its key, as commands name it.
  std::string a_point(const std::string& folder) const {
    return folder + ":" + computations(folder).begin()->first;
  }
  /// A shard of the folder.
  std::string a_shard(const std::string& folder) const {
    return std::filesystem::directory_iterator(*this / (folder + "/runs"))->path().string();
  }
};

}  // namespace sweep_test

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "child_process.h"

namespace integration {

using Json = nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

/// The program that users run, in a folder of its own; its results go to `out` in it.
class Workplace : public kit::TemporaryFolder {
 public:
  kit::Outcome run(const Arguments& arguments) const {
    Arguments all{"run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return kit::run_process(MARKERVP_EXECUTABLE, all, path());
  }
  std::string result_text() const { return kit::read_file(*this / "out/result.json"); }
  Json result() const { return Json::parse(result_text()); }
};

}  // namespace integration

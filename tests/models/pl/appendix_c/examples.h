#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace appendix_c {

/// One worked example of the thesis' appendix C: a component, stimuli with the numbers of the text,
/// and what a trace shows of both.
struct Example {
  std::string name;                                   ///< file name of the trace, without ".vcd"
  void (*write_trace)(const std::filesystem::path&);  ///< runs it and writes its VCD
};

/// All of them in the order of the appendix. C.1 is missing in the thesis: equations 4.1 and 4.2.
const std::vector<Example>& examples();

/// The trace of the example of that name. Throws std::out_of_range for an unknown name.
void write_trace(const std::string& name, const std::filesystem::path& file);

}  // namespace appendix_c

#pragma once

#include <vp/error.h>

#include <string>

#include "temporary_files.h"

/// A trace of signals "a b[8] c", written by hand: what follows the declarations.
class Waves {
 public:
  /// `signals`: "pl.x.tvalid 1, pl.x.tdata 32, ps.text string".
  Waves(const std::string& signals, const std::string& changes, const std::string& scale = "1ns")
      : file(folder_ / "t.vcd") {
    std::string text = "$timescale " + scale + " $end\n";
    char code = '!';
    for (std::size_t at = 0; at < signals.size();) {
      const auto end = std::min(signals.find(", ", at), signals.size());
      const std::string one = signals.substr(at, end - at);
      const auto blank = one.find(' ');
      std::string path = one.substr(0, blank), scopes;
      unsigned depth = 0;
      for (auto dot = path.find('.'); dot != std::string::npos; dot = path.find('.'), ++depth) {
        text += "$scope module " + path.substr(0, dot) + " $end\n";
        path.erase(0, dot + 1);
      }
      const std::string width = one.substr(blank + 1);
      text += (width == "string" ? "$var string 1 "
               : width == "real" ? "$var real 64 "
                                 : "$var wire " + width + " ") +
              code++ + " " + path + " $end\n";
      for (; depth > 0; --depth) text += "$upscope $end\n";
      at = end + 2;
    }
    kit::write_file(file, text + "$enddefinitions $end\n" + changes);
  }

 private:
  kit::TemporaryFolder folder_;

 public:
  std::string file;
  std::string operator/(const std::string& name) const { return folder_ / name; }
};

/// The message of the InputError that `action` throws; "" for none.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
    return "";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

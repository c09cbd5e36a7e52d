#pragma once

#include <vp/error.h>
#include <vp/wave_reader.h>

#include <map>
#include <string>
#include <vector>

#include "temporary_files.h"

/// What a trace says, as lines "100 top.a 101", with the times.
class WaveText : private vp::WaveHandler {
 public:
  explicit WaveText(const std::string& file, const vp::WaveOptions& options = {}) {
    vp::WaveReader reader(file, options);
    for (std::size_t i = 0; i < reader.variables().size(); ++i) {
      names_.emplace(reader.variables()[i].net, reader.paths()[i]);
      declared += reader.paths()[i] + " ";
    }
    reader.select_all();
    reader.read(*this);
    bytes = reader.bytes();
    end_ps = reader.now_ps();
    warnings = reader.warnings();
  }

  std::vector<std::string> lines, warnings;
  std::string declared;
  std::uint64_t bytes = 0, end_ps = 0;

  /// The value of a signal that is at `ps`, as written.
  std::string value(const std::string& path, std::uint64_t ps) const {
    std::string found = "none";
    for (const Change& change : changes_) {
      if (change.ps <= ps && change.path == path) found = change.text;
    }
    return found;
  }

 private:
  struct Change {
    std::uint64_t ps;
    std::string path, text;
  };
  bool at(std::uint64_t ps) override {
    now_ = ps;
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    changes_.push_back({now_, names_.at(net), std::string(value.text)});
    lines.push_back(std::to_string(now_) + " " + names_.at(net) + " " + std::string(value.text));
  }

  void recorded(bool is_recorded) override {
    lines.push_back(std::to_string(now_) + " recorded " + (is_recorded ? "1" : "0"));
  }

  std::uint64_t now_ = 0;
  std::map<std::uint32_t, std::string> names_;
  std::vector<Change> changes_;
};

/// What the reader says of a file with this text; "" if nothing.
inline std::string complaint(const std::string& bytes) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "t.vcd", bytes);
  try {
    const WaveText text(folder / "t.vcd");
    return "";
  } catch (const vp::InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("t.vcd'") + 6);
  }
}

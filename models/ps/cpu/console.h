#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ps {

/// Makes lines of what a program writes.
class Console {
 public:
  /// Called with each complete line, without its line end.
  using Sink = std::function<void(const std::string& line)>;

  /// Lines go to `sink`, each after `prefix`. Without sink they are dropped.
  void connect(Sink sink, std::string prefix = {});
  void write(const char* text, std::size_t length);
  /// Passes on the last line if it has no line end.
  void flush();

 private:
  void pass_line();

  Sink sink_;
  std::string prefix_;
  std::string line_;
};

}  // namespace ps

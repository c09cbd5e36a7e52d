#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <sweep/metrics.h>
#include <sweep/point_file.h>

namespace platform::sweep {

/// What a process that computes points tells of one of them.
struct PointMessage {
  enum class Kind : std::uint8_t {
    computed,     ///< its file is written
    there,        ///< its file was there: somebody else's, or an earlier attempt's
    interrupted,  ///< by a signal to the process
    fault,        ///< of the program itself: `failure` says which
    no_storage    ///< its file cannot be written: the failure's message says why
  };
  Kind kind = Kind::computed;
  std::uint64_t item = 0;  ///< of the engine's list
  double wall_s = 0;
  double cpu_s = 0;  ///< of the run itself
  bool failed = false;
  Failure failure;
  Metrics metrics;
  std::string row;  ///< as Outcome has it
};

/// Names go over the pipe when they differ from those of the message before.
class MessageWriter {
 public:
  /// The message as bytes for MessageReader.
  std::string bytes(const PointMessage& message);

 private:
  Metrics before_;
};

/// Puts messages together again that arrive in pieces.
class MessageReader {
 public:
  /// Metrics share the names of `known`, if they are the same.
  explicit MessageReader(Metrics known = {}) : known_(std::move(known)) {}

  void add(std::string_view bytes) { waiting_ += bytes; }
  /// The next whole message.
  std::optional<PointMessage> next();

 private:
  std::string waiting_;
  Metrics known_;
  Metrics before_;
};

}  // namespace platform::sweep

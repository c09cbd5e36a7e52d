#pragma once

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

#include "child_process.h"

/// A bug to be planted into the RTL that comes with markervp.
struct Bug {
  const char* name;
  const char* ip;
  const char* file;
  const char* right;
  const char* wrong;
  const char* port;          ///< that differs first
  std::uint32_t pixels = 1;  ///< a clock
};

/// How a bench fails while it plays, or when it stops; empty: not at all.
template <class Play>
std::string failure_of(Play play) {
  try {
    play();
    sc_core::sc_stop();
  } catch (const sc_core::sc_report& report) {
    return report.get_msg();
  }
  return "";
}

/// Whether lock-step has found the bug at its port.
void check_port(const Bug& bug, const std::string& failure);

/// RTL of models/pl, as it is or with a bug, built in a folder that goes with this object.
class RtlObjects {
 public:
  struct Object {
    std::string name, ip;
    std::string parameters;  ///< WIDTH=64 HEIGHT=32
    const Bug* bug = nullptr;
  };

  /// Throws std::runtime_error if there is no place for a bug, or if an object cannot be built.
  explicit RtlObjects(const std::vector<Object>& objects);
  std::string file(const std::string& name) const { return folder_ / ("build/" + name + ".so"); }

 private:
  std::string copy(const Object& object) const;
  void cmake(const std::vector<std::string>& arguments) const;

  kit::TemporaryFolder folder_;
};

#pragma once

#include <vp/probe.h>
#include <vp/wave_writer.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace vp {

/// Looks at all traced probes at the end of an instant. Probes that lie in memory are compared
/// without a call, which makes thousands of them bearable.
class ProbePoll {
 public:
  void add(const ProbeBase& probe, WaveWriter::Id id) {
    if (!probe.address()) {
      called_.push_back({&probe, id});
      return;
    }
    switch (probe.byte_count()) {
      case 1:
        bytes_.push_back({probe.address(), id});
        break;
      case 2:
        halves_.push_back({probe.address(), id});
        break;
      case 4:
        words_.push_back({probe.address(), id});
        break;
      default:
        doubles_.push_back({probe.address(), id});
        break;
    }
  }

  /// Calls changed(id, bits) for every probe whose value is not values[id].
  template <class Changed>
  void run(const std::vector<std::uint64_t>& values, const Changed& changed) const {
    compare<std::uint8_t>(bytes_, values, changed);
    compare<std::uint16_t>(halves_, values, changed);
    compare<std::uint32_t>(words_, values, changed);
    compare<std::uint64_t>(doubles_, values, changed);
    for (const Called& called : called_) {
      const std::uint64_t bits = called.probe->bits();
      if (bits != values[called.id]) changed(called.id, bits);
    }
  }

 private:
  struct InMemory {
    const void* address;
    WaveWriter::Id id;
  };
  struct Called {
    const ProbeBase* probe;
    WaveWriter::Id id;
  };

  template <class Word, class Changed>
  static void compare(const std::vector<InMemory>& probes, const std::vector<std::uint64_t>& values,
                      const Changed& changed) {
    for (const InMemory& probe : probes) {
      Word word;
      std::memcpy(&word, probe.address, sizeof word);
      if (word != values[probe.id]) changed(probe.id, std::uint64_t{word});
    }
  }

  std::vector<InMemory> bytes_, halves_, words_, doubles_;
  std::vector<Called> called_;
};

}  // namespace vp

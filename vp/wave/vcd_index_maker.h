#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "vcd_reader.h"

namespace vp {

/// Reads a whole VCD for its index. Places lie 1 MiB apart at first; where that gives more entries
/// than an index may have, every second place is dropped, so memory and index stay bounded.
class VcdIndexMaker final : public WaveHandler, public VcdReader::Clock {
 public:
  /// `most`: changes that are kept.
  VcdIndexMaker(VcdReader& reader, std::size_t most);
  /// Throws InputError.
  void run();

  const std::vector<VcdReader::Place>& places() const { return places_; }
  /// Of the net's changes those that are the last before some place: at which bytes of the file,
  /// rising. The numbers as they are in memory, for the index.
  std::string_view changes_of(std::uint32_t net) const;

 private:
  bool reach(std::uint64_t steps) override;
  bool at(std::uint64_t) override { return true; }
  void change(std::uint32_t net, const WaveValue& value) override;
  void end_block();
  void halve();
  void sort_by_net();

  VcdReader& reader_;
  std::size_t most_;
  std::uint64_t spacing_ = 1 << 20;
  std::vector<VcdReader::Place> places_;  ///< each begins a block
  std::vector<std::uint64_t> last_;       ///< by net: byte of its last change in this block + 1
  std::vector<std::uint32_t> touched_;    ///< nets that changed in this block
  std::vector<std::size_t> block_ends_;   ///< in `nets_` and `offsets_`
  std::vector<std::uint32_t> nets_;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::size_t> begin_of_net_;
};

}  // namespace vp

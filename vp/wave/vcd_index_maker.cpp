#include "vcd_index_maker.h"

#include <algorithm>
#include <utility>

namespace vp {

VcdIndexMaker::VcdIndexMaker(VcdReader& reader, std::size_t most)
    : reader_(reader), most_(most), last_(reader.nets().size()) {}

void VcdIndexMaker::run() {
  reader_.read(std::vector<bool>(last_.size(), true), *this, *this);
  end_block();
  sort_by_net();
}

bool VcdIndexMaker::reach(std::uint64_t) {
  if (!places_.empty() && reader_.offset() < places_.back().offset + spacing_) return true;
  if (!places_.empty()) end_block();
  places_.push_back(reader_.place());
  return true;
}

void VcdIndexMaker::change(std::uint32_t net, const WaveValue&) {
  if (last_[net] == 0) touched_.push_back(net);
  last_[net] = reader_.offset() + 1;
}

void VcdIndexMaker::end_block() {
  for (const std::uint32_t net : touched_) {
    nets_.push_back(net);
    offsets_.push_back(std::exchange(last_[net], 0) - 1);
  }
  touched_.clear();
  block_ends_.push_back(nets_.size());
  while (nets_.size() > most_ && places_.size() > 1) halve();
}

/// Joins each block with the next: of the first only what does not change in the second is left.
void VcdIndexMaker::halve() {
  const std::size_t blocks = places_.size();
  std::vector<std::size_t> ends;
  std::size_t kept = 0;
  for (std::size_t block = 0; block < blocks; block += 2) {
    const std::size_t begin = block == 0 ? 0 : block_ends_[block - 1];
    const std::size_t middle = block_ends_[block];
    const std::size_t end = block_ends_[std::min(block + 1, blocks - 1)];
    for (std::size_t i = middle; i < end; ++i) last_[nets_[i]] = 1;
    for (std::size_t i = begin; i < end; ++i) {
      if (i < middle && last_[nets_[i]] != 0) continue;
      last_[nets_[i]] = 0;
      nets_[kept] = nets_[i];
      offsets_[kept++] = offsets_[i];
    }
    ends.push_back(kept);
    places_[block / 2] = places_[block];
  }
  nets_.resize(kept);
  offsets_.resize(kept);
  block_ends_ = std::move(ends);
  places_.resize((blocks + 1) / 2);
  spacing_ *= 2;
}

void VcdIndexMaker::sort_by_net() {
  begin_of_net_.assign(last_.size() + 1, 0);
  for (const std::uint32_t net : nets_) ++begin_of_net_[net + 1];
  for (std::size_t net = 0; net < last_.size(); ++net) begin_of_net_[net + 1] += begin_of_net_[net];
  std::vector<std::uint64_t> sorted(offsets_.size());
  std::vector<std::size_t> next = begin_of_net_;
  for (std::size_t i = 0; i < nets_.size(); ++i) sorted[next[nets_[i]]++] = offsets_[i];
  offsets_ = std::move(sorted);
}

std::string_view VcdIndexMaker::changes_of(std::uint32_t net) const {
  const std::size_t from = begin_of_net_[net], count = begin_of_net_[net + 1] - from;
  return {reinterpret_cast<const char*>(offsets_.data() + from), count * sizeof offsets_[0]};
}

}  // namespace vp

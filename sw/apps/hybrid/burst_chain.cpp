#include <apps/hybrid/burst_chain.h>
#include <marker/work.h>

namespace hybrid {

void BurstChain::start(std::uint32_t address, std::uint32_t bytes, LastInterrupt last) {
  last_ = last;
  next_address_ = address;
  bursts_ = bytes / burst_bytes_;
  done_ = 0;
  failed_ = false;
  hold_back_last();
  started(dma_.start(next_address_, burst_bytes_));
}

void BurstChain::hold_back_last() {
  if (last_ == LastInterrupt::waits && done_ + 1 == bursts_) dma_.set_completion_interrupt(false);
}

void BurstChain::started(bool accepted) {
  if (!accepted) return fail(dma_.status());
  next_address_ += burst_bytes_;
}

void BurstChain::release_last() {
  last_ = LastInterrupt::comes;
  dma_.set_completion_interrupt(true);
}

void BurstChain::fail(std::uint32_t status) {
  failure_status_ = status;
  failed_ = true;
}

void BurstChain::on_interrupt(void* self) {
  const marker::FunctionScope scope(marker::Function::dma_interrupt);
  marker::work(marker::Work::interrupts, 1);
  BurstChain& chain = *static_cast<BurstChain*>(self);
  const std::uint32_t status = chain.dma_.acknowledge();
  if (drivers::AxiDma::is_error(status)) {
    chain.fail(status);
  } else if (drivers::AxiDma::is_complete(status) && !chain.is_over()) {
    chain.done_ = chain.done_ + 1;
    if (chain.done_ == chain.bursts_) return;
    chain.hold_back_last();
    chain.started(chain.dma_.start_again(chain.next_address_, chain.burst_bytes_));
  }
}

}  // namespace hybrid

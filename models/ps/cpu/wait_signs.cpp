#include <ps/cpu/wait_signs.h>

#include <vp/text.h>

namespace ps {

bool WaitSigns::sees_no_change() const {
  constexpr std::uint64_t many = 1'000;
  return again_ >= many && changed_ == 0;
}

std::string WaitSigns::text(const Surroundings& surroundings, bool irq_masked) const {
  if (loops_) {
    return "; it loops without a call of the HAL, as one does that waits for a variable" +
           surroundings.wait_reason({irq_masked, {}});
  }
  if (by_ == By::none) return {};
  std::string seen = surroundings.register_text(address_, value_);
  if (seen.empty()) seen = Surroundings::plain_text(address_, value_);
  const auto reason = [&] { return surroundings.wait_reason({irq_masked, address_}); };
  if (by_ == By::poll) return "; it polls for a change of any bit of " + seen + reason();
  seen = "; the last register that it read was " + seen;
  if (again_ == 0) return seen;
  return seen + ", " + std::to_string(again_ + 1) + " times in a row, of which " +
         (changed_ == 0 ? "no bit" : "only the bits " + vp::hex(changed_)) + " changed" + reason();
}

}  // namespace ps

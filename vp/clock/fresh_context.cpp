#include <systemc>
#include <vector>

#include <vp/fresh_context.h>

namespace vp {

void begin_fresh_context() {
  // Kept, they are no leaks.
  static auto& contexts = *new std::vector<sc_core::sc_simcontext*>;
  contexts.push_back(new sc_core::sc_simcontext);
  sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = contexts.back();
}

}  // namespace vp

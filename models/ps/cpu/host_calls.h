#pragma once

namespace ps {

/// Does nothing: who calls it gets exit() and its relatives of host_calls.cpp linked.
void use_host_calls();

}  // namespace ps

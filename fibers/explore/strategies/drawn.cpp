// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

std::uint32_t Drawn::among(Choice choice, const Task&, std::uint32_t count) {
  constexpr std::uint64_t rarity = 12;  // rare alternatives have a chance of 1 / rarity
  switch (choice) {
    case Choice::spurious:
    case Choice::loss: return draws_.below(rarity) == 0;
    case Choice::computing:
      switch (draws_.below(4)) {
        case 0: return 0;
        case 1: return count - 1;
        default: break;
      }
      break;
    case Choice::value:
      if (draws_.below(2) == 0) return 0;
      return 1 + draw(count - 1);
    case Choice::task:
    case Choice::waiter:
    case Choice::process: break;
  }
  return draw(count);
}

}  // namespace waitpoint::exploration

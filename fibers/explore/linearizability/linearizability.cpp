// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/linearizability/linearizability.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

namespace waitpoint {
namespace {

using exploration::HistoryPicture;
using exploration::HistoryRow;

void explain(std::ostream& out, const HistoryPicture& picture) {
  if (!picture.bad) {
    out << "its longest linearizable prefix is not known: the search was given up\n";
    return;
  }
  const HistoryRow& bad = picture.rows[*picture.bad];
  out << "no place is left for '" << bad.operation << "' of " << bad.task << "\n";
  const auto placed = std::count_if(picture.rows.begin(), picture.rows.end(), [](auto& row) { return row.place != 0; });
  out << "up to its response the history is linearizable, in the order of the column 'place' (";
  out << placed << (placed == 1 ? " operation)\n" : " operations)\n");
}

}  // namespace

std::string Linearizability::svg() const {
  return verdict == Verdict::not_linearizable ? to_svg(picture) : std::string();
}

std::ostream& operator<<(std::ostream& out, const Linearizability& result) {
  switch (result.verdict) {
    case Linearizability::Verdict::linearizable: return out << "linearizable";
    case Linearizability::Verdict::undecided:
      return out << "linearizability undecided after " << result.configurations_max
                 << " configurations: too many operations overlap";
    case Linearizability::Verdict::not_linearizable: break;
  }
  out << "not linearizable\n";
  if (!result.key.empty()) out << "operations on key " << result.key << ":\n";
  explain(out, result.picture);
  return out << to_text(result.picture);
}

}  // namespace waitpoint

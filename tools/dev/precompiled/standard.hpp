// SPDX-License-Identifier: BSD-3-Clause
// The headers of the standard library that most sources include, parsed once for each target (Meson's cpp_pch).
//
// A precompiled header saves time and nothing else: every file includes what it uses, and builds with -Db_pch=false and
// -Dgrouped=false, as those with sanitizers and those of --wraps are, prove it. Without a guard: GCC wants none in what
// it precompiles.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

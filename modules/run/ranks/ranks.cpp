// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/ranks/ranks.hpp"

#include <stdexcept>

#include "core/error.hpp"
#include "core/exception_text.hpp"

namespace waitpoint::run {
namespace {

struct Thrown {
  enum class Kind : std::uint8_t { nothing, bad_input, other };

  Kind kind = Kind::nothing;
  std::string file, message;
  int line = 0;
};
void carry(auto& archive, Thrown& thrown) { archive(thrown.kind, thrown.file, thrown.message, thrown.line); }

// Without the place, which a BadInput puts before its message.
std::string message_of(const BadInput& error) {
  const std::string place = error.line() > 0 ? error.file() + ":" + std::to_string(error.line()) : error.file();
  const std::string what = error.what();
  return what.starts_with(place + ": ") ? what.substr(place.size() + 2) : what;
}

struct Named {
  std::string host, value;
};
void carry(auto& archive, Named& named) { archive(named.host, named.value); }

}  // namespace

const std::vector<std::string_view>& Ranks::gather_bytes(std::string_view own) {
  return transport_.gather(own, [this](double seconds) { waiting_(seconds, place_()); });
}

void Ranks::act_together(const std::function<void()>& act) {
  Thrown own;
  try {
    act();
  } catch (const BadInput& error) {
    own = {Thrown::Kind::bad_input, error.file(), message_of(error), error.line()};
  } catch (const std::exception& error) {
    own = {Thrown::Kind::other, "", exception_text(error), 0};
  }
  for (const Thrown& thrown : gather(own)) {
    if (thrown.kind == Thrown::Kind::bad_input) throw BadInput(thrown.file, thrown.line, thrown.message);
    if (thrown.kind == Thrown::Kind::other) throw std::runtime_error(thrown.message);
  }
}

void Ranks::check_same(const char* what, const std::string& value) {
  const std::vector<Named> all = gather(Named{transport_.host(), value});
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].value != all[0].value)
      throw BadInput("rank " + std::to_string(i) + " on " + all[i].host, std::string("expected the same ") + what +
                                                                             " on all ranks, '" + all[0].value +
                                                                             "', found '" + all[i].value + "'");
}

}  // namespace waitpoint::run

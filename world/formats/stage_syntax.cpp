// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_syntax.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "world/formats/beside.hpp"
#include "world/formats/included_files.hpp"
#include "world/formats/limits.hpp"

namespace waitpoint::world {
namespace {

constexpr int nesting_max = 64;
constexpr std::size_t definition_count_max = 10000;
constexpr std::array<std::string_view, 15> built_in_types = {
    "actuator", "blinkenlight", "block",    "blobfinder", "bumper", "camera", "fiducial", "gripper",
    "laser",    "model",        "position", "ranger",     "sensor", "wifi",   "window"};

// Names of earlier versions of Stage for a type, until a file defines its own.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> old_names = {
    {{"map", "model"}, {"sonar", "ranger"}}};

std::string_view present_name(std::string_view type) {
  for (const auto& [old, present] : old_names)
    if (type == old) return present;
  return type;
}

struct Token {
  enum class Kind { word, text, open, close, list_open, list_close, end };
  Kind kind = Kind::end;
  std::string_view text;
  int line = 0;
};

// The tokens of one file.
class Tokens {
 public:
  Tokens(std::string_view text, const std::string& file) : rest_(text), file_(file) { advance(); }

  const Token& next() const { return next_; }
  Token take() {
    const Token taken = next_;
    advance();
    return taken;
  }
  StagePlace place(const Token& token) const { return {&file_, token.line}; }
  [[noreturn]] void fail(const Token& at, const std::string& message) const { throw BadInput(file_, at.line, message); }

  // The description of a token in messages.
  static std::string described(const Token& token) {
    constexpr std::size_t shown_max = 20;
    return token.kind == Token::Kind::end ? "the file's end" : "'" + std::string(token.text.substr(0, shown_max)) + "'";
  }

 private:
  void drop(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

  void skip_blanks() {
    while (!rest_.empty()) {
      if (rest_[0] == '#') {
        drop(rest_.find('\n'));
      } else if (rest_[0] == '\n') {
        ++line_;
        drop(1);
      } else if (rest_[0] == ' ' || rest_[0] == '\t' || rest_[0] == '\r') {
        drop(1);
      } else {
        return;
      }
    }
  }

  void advance() {
    using Kind = Token::Kind;
    skip_blanks();
    next_ = {Kind::end, rest_.substr(0, 1), line_};
    if (rest_.empty()) return;
    switch (rest_[0]) {
      case '(': next_.kind = Kind::open; break;
      case ')': next_.kind = Kind::close; break;
      case '[': next_.kind = Kind::list_open; break;
      case ']': next_.kind = Kind::list_close; break;
      case '"': advance_text(); return;
      default: advance_word(); return;
    }
    drop(1);
  }

  void advance_text() {
    const std::size_t end = rest_.find_first_of("\"\n", 1);
    next_.kind = Token::Kind::text;
    if (end == rest_.npos || rest_[end] == '\n') fail(next_, "expected a closing '\"' on this line");
    next_.text = rest_.substr(1, end - 1);
    drop(end + 1);
  }

  void advance_word() {
    constexpr std::string_view ends = " \t\r\n()[]\"#";
    std::size_t end = std::min(rest_.find_first_of(ends), rest_.size());
    // "point[0]" is one word, and so is "polygon[0].point[1]".
    while (end < rest_.size() && rest_[end] == '[') {
      const std::size_t closing = rest_.find_first_not_of("0123456789", end + 1);
      if (closing == rest_.npos || closing == end + 1 || rest_[closing] != ']') break;
      end = std::min(rest_.find_first_of(ends, closing + 1), rest_.size());
    }
    next_.kind = Token::Kind::word;
    next_.text = rest_.substr(0, end);
    drop(end);
  }

  std::string_view rest_;
  const std::string& file_;
  int line_ = 1;
  Token next_;
};

}  // namespace

class StageParser {
 public:
  StageParser(StageText& text, const std::string& contents, const std::string& file)
      : text_(text), included_(file, contents, stage_bytes_max) {
    if (contents.size() > stage_bytes_max) {
      throw BadInput(file, "expected a world of at most " + std::to_string(stage_bytes_max >> 20) + " MiB");
    }
  }

  void read_file(std::string contents, const std::string& file) {
    const std::string& name = text_.names_.emplace_back(file);
    Tokens in(text_.texts_.emplace_back(std::move(contents)), name);
    while (in.next().kind != Kind::end) {
      const Token word = expect_word(in, "a type or a property");
      if (word.text == "include") {
        read_include(in, name);
      } else if (word.text == "define") {
        read_definition(in);
      } else {
        read_item(in, word, text_.world_, 0);
      }
    }
  }

 private:
  using Kind = Token::Kind;

  static Token expect_word(Tokens& in, const std::string& what) {
    const Token token = in.take();
    if (token.kind != Kind::word) in.fail(token, "expected " + what + ", found " + Tokens::described(token));
    return token;
  }

  void read_include(Tokens& in, const std::string& from) {
    const Token name = in.take();
    if (name.kind != Kind::text) in.fail(name, "expected a file's name in quotes, found " + Tokens::described(name));
    const std::string file = beside(from, std::string(name.text));
    read_file(included_.enter(file, from, name.line), file);
    included_.leave();
  }

  void read_definition(Tokens& in) {
    const Token name = expect_word(in, "the name of a type");
    const Token type = expect_word(in, "the type that '" + std::string(name.text) + "' is made from");
    StageThing thing = thing_of(in, type, name);
    read_body(in, thing, 0);
    if (text_.definitions_.size() == definition_count_max) {
      in.fail(name, "expected at most " + std::to_string(definition_count_max) + " definitions");
    }
    const StageThing& definition = text_.definitions_.emplace_back(std::move(thing));
    text_.types_[definition.type] = &definition;  // the last definition of a name counts
  }

  // A thing of that type, without its body.
  StageThing thing_of(const Tokens& in, const Token& type, const Token& name) {
    StageThing thing;
    thing.type = name.text;
    thing.place = in.place(name);
    if (const auto found = text_.types_.find(type.text); found != text_.types_.end()) {
      thing.base = found->second;
      thing.known = thing.base->known;
      thing.built_in = thing.base->built_in;
      thing.depth = thing.base->depth + 1;
      thing.nesting = thing.base->nesting;
      if (thing.depth > nesting_max) in.fail(type, "expected types derived from types at most 64 deep");
    } else if (const auto built_in = std::find(built_in_types.begin(), built_in_types.end(), present_name(type.text));
               built_in != built_in_types.end()) {
      thing.built_in = *built_in;
    } else {
      in.fail(type, "there is no type " + Tokens::described(type) + hint(type.text));
    }
    return thing;
  }

  std::string hint(std::string_view name) const {
    constexpr std::size_t letters_max = 40;  // longer names are not misspelt ones
    if (name.size() > letters_max) return "";
    std::vector<std::string_view> names(built_in_types.begin(), built_in_types.end());
    for (const auto& [type, definition] : text_.types_)
      if (type.size() <= letters_max) names.push_back(type);
    return did_you_mean(name, names);
  }

  // "( ... )".
  void read_body(Tokens& in, StageThing& thing, int nesting) {
    const Token open = in.take();
    if (open.kind != Kind::open) in.fail(open, "expected '(', found " + Tokens::described(open));
    if (nesting > nesting_max) in.fail(open, "expected things in things at most 64 deep");
    while (in.next().kind != Kind::close) {
      if (in.next().kind == Kind::end) in.fail(open, "expected ')' for this '(', found the file's end");
      read_item(in, expect_word(in, "a type, a property or ')'"), thing, nesting + 1);
    }
    in.take();
    for (const StageProperty& property : thing.properties) {
      const auto key = std::find(stage_keys.begin(), stage_keys.end(), property.name);
      if (key != stage_keys.end()) thing.known[static_cast<std::size_t>(key - stage_keys.begin())] = &property;
    }
  }

  // A thing or a property of `holder` that begins with `word`.
  void read_item(Tokens& in, const Token& word, StageThing& holder, int nesting) {
    if (in.next().kind == Kind::open) {
      StageThing thing = thing_of(in, word, word);
      read_body(in, thing, nesting);
      holder.nesting = std::max(holder.nesting, thing.nesting + 1);
      if (holder.nesting > nesting_max) in.fail(word, "expected things in things at most 64 deep");
      holder.things.push_back(std::move(thing));
      return;
    }
    StageProperty property = {word.text, {}, in.place(word)};
    const Token value = in.take();
    if (value.kind == Kind::list_open) {
      while (in.next().kind != Kind::list_close) {
        const Token element = in.take();
        if (element.kind != Kind::word && element.kind != Kind::text)
          in.fail(element, "expected ']' or a value, found " + Tokens::described(element));
        property.values.push_back(element.text);
      }
      in.take();
    } else if (value.kind == Kind::word || value.kind == Kind::text) {
      property.values.push_back(value.text);
    } else {
      in.fail(value, "expected a value of " + Tokens::described(word) + ", found " + Tokens::described(value));
    }
    holder.properties.push_back(std::move(property));
  }

  StageText& text_;
  IncludedFiles included_;
};

const StageProperty* StageThing::find_named(std::string_view name) const {
  for (const StageThing* at = this; at != nullptr; at = at->base) {
    const auto found = std::find_if(at->properties.rbegin(), at->properties.rend(),
                                    [&](const StageProperty& property) { return property.name == name; });
    if (found != at->properties.rend()) return &*found;
  }
  return nullptr;
}

StageText::StageText(const std::string& contents, const std::string& file) {
  StageParser(*this, contents, file).read_file(contents, file);
}

}  // namespace waitpoint::world

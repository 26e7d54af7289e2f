// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/preprocessor.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "modules/description/constant_expression.hpp"

namespace waitpoint::description {
namespace {

// Bounds against files that include themselves and constants that multiply.
constexpr std::size_t include_depth_max = 32;
constexpr std::size_t macro_depth_max = 64;
constexpr std::size_t tokens_max = 200'000;
constexpr std::size_t replacement_tokens_max = 200'000;

struct Macro {
  bool has_parameters = false;
  std::vector<Token> tokens;
};

/// A nested #if: true while the following lines are in use.
struct Condition {
  SourcePlace place;
  bool outer = true;  ///< the lines around it are in use
  bool in_use = true;
  bool was_in_use = true;  ///< this branch or an earlier one
  bool in_else = false;
};

class Preprocessor {
 public:
  Preprocessor(const std::vector<std::string>& include_folders, const ReadFile& read_file)
      : include_folders_(include_folders), read_file_(read_file) {}

  void read(const SourceFile& source, std::size_t depth) {
    const auto file = std::make_shared<const std::string>(source.path);
    const std::vector<Token> tokens = lex(source.contents, file);
    const std::size_t conditions_before = conditions_.size();
    for (std::size_t at = 0; at < tokens.size();) {
      if (!is(tokens[at], "#") || !tokens[at].first_of_line) {
        if (in_use() && tokens[at].kind != TokenKind::end) put(tokens[at], 0);
        ++at;
        continue;
      }
      const std::size_t begin = at;
      for (++at; at < tokens.size() && !tokens[at].first_of_line;) ++at;
      directive(
          {tokens.begin() + static_cast<std::ptrdiff_t>(begin) + 1, tokens.begin() + static_cast<std::ptrdiff_t>(at)},
          tokens[begin], source, depth);
    }
    if (conditions_.size() > conditions_before)
      reject(conditions_.back().place, "expected '#endif' for this condition");
    if (depth == 0) result_.tokens.push_back(tokens.back());
  }

  Preprocessed result() { return std::move(result_); }

 private:
  bool in_use() const { return conditions_.empty() || conditions_.back().in_use; }

  // Appends a token, or the value of the constant of its name.
  void put(Token token, std::size_t depth) {
    const auto found = token.kind == TokenKind::name ? macros_.find(token.text) : macros_.end();
    if (found == macros_.end() || token.text == token.macro) {
      if (result_.tokens.size() >= tokens_max)
        reject(token.place, "expected at most 200000 words, with included files");
      result_.tokens.push_back(std::move(token));
      return;
    }
    if (found->second.has_parameters)
      reject(token.place, "expected no use of a macro with parameters, found '" + token.text + "'");
    if (depth > macro_depth_max) reject(token.place, "expected constants nested at most 64 deep");
    count_replacement(found->second, token.place);
    for (Token replaced : found->second.tokens) {
      replaced.place = token.place;
      replaced.begin = token.begin;
      replaced.end = token.end;
      replaced.macro = token.text;
      put(std::move(replaced), depth + 1);
    }
  }

  // The depth alone is no bound: constants that each have another one twice double with every level, and may be empty.
  void count_replacement(const Macro& macro, const SourcePlace& place) {
    replacement_tokens_ += macro.tokens.size();
    if (replacement_tokens_ > replacement_tokens_max)
      reject(place, "expected at most 200000 words of constants in place of their names");
  }

  void directive(std::vector<Token> words, const Token& hash, const SourceFile& source, std::size_t depth) {
    if (words.empty()) return;
    const Token name = words.front();
    words.erase(words.begin());
    if (conditional(name, words)) return;
    if (!in_use()) return;
    const std::size_t end = words.empty() ? name.end : words.back().end;
    if (depth == 0 && (is(name, "include") || is(name, "define") || is(name, "undef")))
      result_.directives.push_back({source.contents.substr(hash.begin, end - hash.begin), hash.begin});
    if (is(name, "include"))
      include(name, words, source, depth);
    else if (is(name, "define"))
      define(name, words);
    else if (is(name, "undef") && !words.empty())
      macros_.erase(words[0].text);
    else if (is(name, "error"))
      reject(name.place, "#error" + (words.empty() ? std::string() : " " + words[0].text));
    else if (!is(name, "pragma") && !is(name, "warning") && !is(name, "ident") && !is(name, "undef"))
      reject(name.place, "expected a directive of C's preprocessor, found '#" + name.text + "'");
  }

  void define(const Token& name, std::vector<Token> words) {
    if (words.empty() || words[0].kind != TokenKind::name) reject(name.place, "expected a name behind #define");
    Macro macro;
    macro.has_parameters = words.size() > 1 && is(words[1], "(") && !words[1].after_space;
    macro.tokens.assign(words.begin() + 1, words.end());
    macros_[words[0].text] = std::move(macro);
  }

  void include(const Token& name, const std::vector<Token>& words, const SourceFile& source, std::size_t depth) {
    if (!words.empty() && is(words[0], "<")) return;
    if (words.empty() || words[0].kind != TokenKind::text)
      reject(name.place, "expected a file in quotes behind #include");
    if (depth >= include_depth_max) reject(name.place, "expected files included at most 32 deep");
    namespace fs = std::filesystem;
    std::vector<fs::path> folders = {fs::path(source.path).parent_path()};
    folders.insert(folders.end(), include_folders_.begin(), include_folders_.end());
    for (const fs::path& folder : folders) {
      const std::string path = (folder / words[0].text).string();
      if (std::optional<std::string> contents = read_file_(path)) return read({path, std::move(*contents)}, depth + 1);
    }
    reject(words[0].place, "expected a file to include, found no '" + words[0].text + "'");
  }

  // True if the directive is one of conditions.
  bool conditional(const Token& name, std::vector<Token> words) {
    if (is(name, "ifdef") || is(name, "ifndef") || is(name, "if")) {
      Condition condition{name.place, in_use()};
      condition.in_use = condition.outer && holds(name, std::move(words));
      condition.was_in_use = condition.in_use;
      conditions_.push_back(condition);
      return true;
    }
    if (!is(name, "elif") && !is(name, "else") && !is(name, "endif")) return false;
    if (conditions_.empty()) reject(name.place, "expected a condition before '#" + name.text + "'");
    Condition& condition = conditions_.back();
    if (is(name, "endif")) {
      conditions_.pop_back();
      return true;
    }
    if (condition.in_else) reject(name.place, "expected '#endif' behind #else, found '#" + name.text + "'");
    condition.in_else = is(name, "else");
    condition.in_use = condition.outer && !condition.was_in_use && (condition.in_else || holds(name, std::move(words)));
    condition.was_in_use |= condition.in_use;
    return true;
  }

  bool holds(const Token& name, std::vector<Token> words) {
    if (words.empty()) reject(name.place, "expected a condition behind '#" + name.text + "'");
    if (is(name, "ifdef")) return macros_.contains(words[0].text);
    if (is(name, "ifndef")) return !macros_.contains(words[0].text);
    words.push_back(end_token(words.back().place));
    TokenStream tokens(std::move(words));
    const std::int64_t value = constant_expression(
        tokens, [this](TokenStream& rest, const Token& word) { return condition_value(rest, word); });
    if (!tokens.at_end()) tokens.fail("expected the end of the condition");
    return value != 0;
  }

  // As in C, a name that is no constant counts as 0.
  std::optional<std::int64_t> condition_value(TokenStream& rest, const Token& word) {
    if (is(word, "defined")) {
      const bool in_parentheses = rest.accept("(");
      const bool known = macros_.contains(rest.expect_name("a name behind 'defined'").text);
      if (in_parentheses) rest.expect(")", "behind 'defined'");
      return known;
    }
    const auto found = macros_.find(word.text);
    if (found == macros_.end() || found->second.has_parameters || found->second.tokens.empty()) return 0;
    if (++condition_depth_ > macro_depth_max) reject(word.place, "expected constants nested at most 64 deep");
    count_replacement(found->second, word.place);
    std::vector<Token> tokens = found->second.tokens;
    tokens.push_back(end_token(word.place));
    TokenStream of_macro(std::move(tokens));
    const std::int64_t value =
        constant_expression(of_macro, [this](TokenStream& s, const Token& w) { return condition_value(s, w); });
    --condition_depth_;
    return value;
  }

  const std::vector<std::string>& include_folders_;
  const ReadFile& read_file_;
  std::map<std::string, Macro> macros_;
  std::vector<Condition> conditions_;
  std::size_t condition_depth_ = 0;
  std::size_t replacement_tokens_ = 0;
  Preprocessed result_;
};

}  // namespace

Preprocessed preprocess(const SourceFile& source, const std::vector<std::string>& include_folders,
                        const ReadFile& read_file) {
  Preprocessor preprocessor(include_folders, read_file);
  preprocessor.read(source, 0);
  return preprocessor.result();
}

}  // namespace waitpoint::description

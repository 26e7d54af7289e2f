// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/parser.hpp"

#include <algorithm>
#include <utility>

#include "core/nearest_name.hpp"
#include "modules/control/lexer.hpp"
#include "modules/control/predicate.hpp"

namespace waitpoint::control {
namespace {

using Operator = Expression::Kind;

constexpr int depth_max = 100;
constexpr std::size_t operands_max = 1000;
constexpr double seconds_max = 1e9;

constexpr std::pair<std::string_view, Relation> relations[] = {
    {"<", Relation::less},       {"<=", Relation::less_equal},    {"==", Relation::equal},
    {"!=", Relation::not_equal}, {">=", Relation::greater_equal}, {">", Relation::greater}};
constexpr std::pair<std::string_view, double> time_units[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}};
constexpr std::pair<std::string_view, Operator> of_expressions[] = {
    {"past", Operator::past}, {"always", Operator::always}, {"never", Operator::never}, {"since", Operator::since}};
constexpr std::pair<std::string_view, Operator> of_patterns[] = {{"request", Operator::requested},
                                                                 {"running", Operator::running},
                                                                 {"succeeded", Operator::succeeded},
                                                                 {"failed", Operator::failed},
                                                                 {"duration", Operator::lasting}};
constexpr std::pair<std::string_view, Operator> of_posters[] = {{"given", Operator::given}, {"age", Operator::aged}};

template <class Table>
auto find(const Table& table, std::string_view word) {
  return std::find_if(std::begin(table), std::end(table), [&](const auto& entry) { return entry.first == word; });
}

std::size_t dots(std::string_view word) { return static_cast<std::size_t>(std::count(word.begin(), word.end(), '.')); }

Expression joined(Operator kind, std::vector<Expression> operands, Place place) {
  if (operands.size() == 1) return std::move(operands.front());
  Expression whole;
  whole.kind = kind;
  whole.operands = std::move(operands);
  whole.place = place;
  return whole;
}

Expression negated(Expression operand) {
  Expression whole;
  whole.kind = Operator::negation;
  whole.place = operand.place;
  whole.operands.push_back(std::move(operand));
  return whole;
}

Expression running(const RequestPattern& pattern) {
  Expression whole;
  whole.kind = Operator::running;
  whole.pattern = pattern;
  whole.place = pattern.place;
  return whole;
}

class Parser {
 public:
  Parser(std::string_view contents, const std::string& file)
      : file_(file), lexer_(contents, file), token_(lexer_.next()) {}

  Rules rules() {
    Rules rules;
    rules.file = file_;
    bool has_cost = false, has_period = false;
    for (bool is_setting = true; is_setting;) {
      is_setting = false;
      for (auto [word, value] : {std::pair("cost", &rules.cost), std::pair("period", &rules.period)}) {
        const Place place = token_.place;
        if (!accept(word)) continue;
        if (std::exchange(value == &rules.cost ? has_cost : has_period, true))
          throw bad(file_, place, "expected one " + std::string(word) + " in a file");
        *value = time();
        if (value == &rules.period && *value <= Duration()) throw bad(file_, place, "expected a period above 0");
        expect(";");
        is_setting = true;
      }
    }
    std::vector<std::string> names;
    while (!at_end()) context(rules, names);
    return rules;
  }

 private:
  // --- tokens ---

  bool at_end() const { return token_.kind == Token::Kind::end; }
  Token take() { return std::exchange(token_, lexer_.next()); }
  bool accept(std::string_view text) {
    if (!token_.is(text)) return false;
    take();
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text)) refuse("'" + std::string(text) + "'");
  }
  [[noreturn]] void refuse(const std::string& expected) const { refuse(expected, token_); }
  [[noreturn]] void refuse(const std::string& expected, const Token& found, const std::string& hint = "") const {
    const std::string text =
        found.kind == Token::Kind::end ? "the end of the file" : "'" + std::string(found.text) + "'";
    throw bad(file_, found.place, "expected " + expected + ", found " + text + hint);
  }
  /// A word of `least` to `most` dots.
  Token word(const char* expected, std::size_t least, std::size_t most) {
    if (token_.kind != Token::Kind::word || dots(token_.text) < least || dots(token_.text) > most) refuse(expected);
    return take();
  }
  Duration time() {
    if (token_.kind != Token::Kind::number) refuse("a time such as 20 s");
    const Token number = take();
    const auto unit = find(time_units, token_.text);
    if (unit == std::end(time_units)) refuse("s, ms or us after a time");
    const double seconds = number.number * unit->second;
    if (!(seconds >= 0 && seconds <= seconds_max)) refuse("a time from 0 to 1e9 s", number);
    take();
    return Duration::from_seconds(seconds);
  }

  // --- contexts and checks ---

  void context(Rules& rules, std::vector<std::string>& names) {
    if (!token_.is("context")) {
      const std::string_view known[] = {"context", "cost", "period"};
      refuse("a context", token_, did_you_mean(token_.text, known));
    }
    take();
    const std::string name = unique_name(names, "");
    expect("{");
    std::vector<Expression> when;
    if (accept("when")) {
      expect(":");
      when.push_back(expression());
      expect(";");
    }
    std::vector<std::string> checks;
    while (!accept("}")) {
      if (!token_.is("check")) refuse("a check or '}'");
      take();
      Check check;
      check.place = token_.place;
      check.name = unique_name(checks, name + ".");
      expect("{");
      Expression forbidden = condition();
      std::vector<Expression> both = when;
      both.push_back(std::move(forbidden));
      check.forbidden = joined(Operator::conjunction, std::move(both), check.place);
      while (!accept("}")) action(check);
      rules.checks.push_back(std::move(check));
    }
  }

  std::string unique_name(std::vector<std::string>& names, const std::string& prefix) {
    const Token name = word(prefix.empty() ? "the name of a context" : "the name of a check", 0, 0);
    if (std::find(names.begin(), names.end(), name.text) != names.end()) refuse("a name that is not given twice", name);
    names.emplace_back(name.text);
    return prefix + names.back();
  }

  Expression condition() {
    const Token kind = take();
    if (!kind.is("fail") && !kind.is("never") && !kind.is("always") && !kind.is("exclusive"))
      refuse("fail, never, always or exclusive", kind);
    expect(":");
    Expression forbidden = kind.is("exclusive") ? exclusion(kind.place) : expression();
    expect(";");
    return kind.is("always") ? negated(std::move(forbidden)) : forbidden;
  }

  /// Two of the patterns at a time.
  Expression exclusion(Place place) {
    const std::vector<RequestPattern> patterns = pattern_list();
    if (patterns.size() < 2) refuse("',' and a second request that excludes the first");
    std::vector<Expression> pairs;
    for (std::size_t i = 0; i < patterns.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (is_one_of_both(patterns[j], patterns[i]))
          throw bad(file_, patterns[i].place,
                    "expected requests that exclude each other: one " + request_name(patterns[i]) + " can be both");
        count_operand();
        std::vector<Expression> two;
        two.push_back(running(patterns[j]));
        two.push_back(running(patterns[i]));
        pairs.push_back(joined(Operator::conjunction, std::move(two), place));
      }
    }
    return joined(Operator::disjunction, std::move(pairs), place);
  }

  void action(Check& check) {
    const Token kind = take();
    const bool is_delay = kind.is("delay");
    if (!is_delay && !kind.is("interrupt")) refuse("delay, interrupt or '}'", kind);
    std::vector<RequestPattern>& patterns = is_delay ? check.delayed : check.interrupted;
    if (!patterns.empty()) refuse("one such action in a check", kind);
    expect(":");
    patterns = pattern_list();
    expect(is_delay ? "for" : "within");
    (is_delay ? check.delay_max : check.interruption_max) = time();
    expect(";");
  }

  // --- expressions ---

  void count_operand() {
    if (++operands_ > operands_max) refuse("at most " + std::to_string(operands_max) + " operands in a file");
  }

  template <class Next>
  Expression chain(const char* sign, Operator kind, Next next) {
    const Place place = token_.place;
    std::vector<Expression> operands;
    do operands.push_back(next());
    while (accept(sign));
    return joined(kind, std::move(operands), place);
  }

  Expression expression() {
    if (++depth_ > depth_max) refuse("at most " + std::to_string(depth_max) + " nested expressions");
    Expression whole = chain("||", Operator::disjunction,
                             [this] { return chain("&&", Operator::conjunction, [this] { return operand(); }); });
    --depth_;
    return whole;
  }

  Expression operand() {
    count_operand();
    bool is_negated = false;
    while (accept("!")) is_negated = !is_negated;
    Expression whole = positive_operand();
    return is_negated ? negated(std::move(whole)) : whole;
  }

  Expression positive_operand() {
    if (accept("(")) {
      Expression inner = expression();
      expect(")");
      return inner;
    }
    Expression whole;
    whole.place = token_.place;
    const auto as = [&](Operator kind) {
      whole.kind = kind;
      take();
      expect("(");
    };
    if (token_.is("true") || token_.is("false")) {
      whole.truth = take().is("true");
    } else if (const auto* const found = find(of_expressions, token_.text); found != std::end(of_expressions)) {
      as(found->second);
      whole.operands.push_back(expression());
      if (whole.kind == Operator::since) {
        expect(",");
        whole.operands.push_back(expression());
      }
      expect(")");
    } else if (const auto* const of = find(of_patterns, token_.text); of != std::end(of_patterns)) {
      as(of->second);
      whole.pattern = pattern();
      expect(")");
      if (whole.kind == Operator::lasting) whole.time = longer();
    } else if (const auto* const about = find(of_posters, token_.text); about != std::end(of_posters)) {
      as(about->second);
      whole.poster = word("a poster, such as rflex.odometry", 1, 1).text;
      expect(")");
      if (whole.kind == Operator::aged) whole.time = longer();
    } else {
      whole.kind = Operator::comparison;
      whole.comparison = comparison("an expression, such as running(ndd.GoTo) or a poster's field", 2);
    }
    return whole;
  }

  Duration longer() {
    expect(">");
    return time();
  }

  Comparison comparison(const char* expected, std::size_t dots_least) {
    const Token field = word(expected, dots_least, std::string_view::npos);
    Comparison comparison{std::string(field.text), Relation::not_equal, 0, field.place};
    const auto* const relation = find(relations, token_.text);
    if (relation == std::end(relations)) return comparison;
    comparison.relation = relation->second;
    take();
    if (token_.is("true") || token_.is("false")) {
      comparison.number = take().is("true") ? 1 : 0;
    } else {
      if (token_.kind != Token::Kind::number) refuse("a number");
      comparison.number = take().number;
    }
    return comparison;
  }

  std::vector<RequestPattern> pattern_list() {
    std::vector<RequestPattern> patterns;
    do patterns.push_back(pattern());
    while (accept(","));
    return patterns;
  }

  RequestPattern pattern() {
    count_operand();
    const Token name = word("a request, such as ndd.GoTo", 1, 1);
    const std::size_t dot = name.text.find('.');
    RequestPattern pattern{
        std::string(name.text.substr(0, dot)), std::string(name.text.substr(dot + 1)), {}, name.place};
    if (!accept("(")) return pattern;
    while (!accept(")")) {
      if (!pattern.inputs.empty()) expect(",");
      count_operand();
      pattern.inputs.push_back(comparison("a field of the request's input", 0));
    }
    return pattern;
  }

  const std::string& file_;
  Lexer lexer_;
  Token token_;
  int depth_ = 0;
  std::size_t operands_ = 0;
};

}  // namespace

Rules parse_rules(std::string_view contents, const std::string& file) { return Parser(contents, file).rules(); }

}  // namespace waitpoint::control

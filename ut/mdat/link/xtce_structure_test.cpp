// What the schema of XTCE 1.2 (OMG formal/18-10-04) asks of the elements that the dictionary uses: which may stand where, in which order,
// with which attributes and values. Written down from the schema, not from the generator.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "mdat/link/dictionary_text.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Words = std::vector<std::string>;

Words words(const std::string& text) {
  std::istringstream stream(text);
  Words all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

// Children in their order, each with ? (may be absent) or + (once or more) behind it; "any of" means any number of these, in any order.
// Attributes with the kind of their value; ! behind it: it has to be there.
struct Rule {
  std::string children, attributes;
  std::string text = "none";  // kind of the element's own text
};

const std::map<std::string, Rule>& rules() {
  static const std::string kNamed = "name=name! shortDescription=text ";
  static const std::string kType = "UnitSet? ", kInteger = "sizeInBits=positive signed=boolean", kFloat = "sizeInBits=float_size";
  static const std::map<std::string, Rule> kRules = {
      {"SpaceSystem", {"TelemetryMetaData? CommandMetaData?", kNamed + "xmlns=text!"}},
      {"TelemetryMetaData", {"ParameterTypeSet? ParameterSet? ContainerSet?", ""}},
      {"CommandMetaData", {"ParameterTypeSet? ParameterSet? ArgumentTypeSet? MetaCommandSet? CommandContainerSet?", ""}},
      {"ParameterTypeSet", {"any of IntegerParameterType FloatParameterType EnumeratedParameterType ArrayParameterType", ""}},
      {"ArgumentTypeSet", {"any of IntegerArgumentType FloatArgumentType EnumeratedArgumentType ArrayArgumentType", ""}},
      {"IntegerParameterType", {kType + "IntegerDataEncoding? ValidRange?", kNamed + kInteger}},
      {"FloatParameterType", {kType + "FloatDataEncoding? ValidRange?", kNamed + kFloat}},
      {"EnumeratedParameterType", {kType + "IntegerDataEncoding? EnumerationList", kNamed}},
      {"ArrayParameterType", {"DimensionList", kNamed + "arrayTypeRef=reference!"}},
      {"IntegerArgumentType", {kType + "IntegerDataEncoding? ValidRangeSet?", kNamed + kInteger}},
      {"FloatArgumentType", {kType + "FloatDataEncoding? ValidRangeSet?", kNamed + kFloat}},
      {"EnumeratedArgumentType", {kType + "IntegerDataEncoding? EnumerationList", kNamed}},
      {"ArrayArgumentType", {"DimensionList", kNamed + "arrayTypeRef=reference!"}},
      {"UnitSet", {"Unit?", ""}},
      {"Unit", {"", "", "text"}},
      {"IntegerDataEncoding", {"", "sizeInBits=positive encoding=encoding"}},
      {"FloatDataEncoding", {"", "sizeInBits=float_size"}},
      {"ValidRangeSet", {"ValidRange+", ""}},
      {"ValidRange", {"", "minInclusive=bound maxInclusive=bound"}},
      {"EnumerationList", {"Enumeration+", ""}},
      {"Enumeration", {"", "value=long! label=text! shortDescription=text"}},
      {"DimensionList", {"Dimension+", ""}},
      {"Dimension", {"StartingIndex EndingIndex", ""}},
      {"StartingIndex", {"FixedValue", ""}},
      {"EndingIndex", {"FixedValue", ""}},
      {"FixedValue", {"", "", "long"}},
      {"ParameterSet", {"Parameter+", ""}},
      {"Parameter", {"", kNamed + "parameterTypeRef=reference!"}},
      {"ContainerSet", {"SequenceContainer+", ""}},
      {"SequenceContainer", {"EntryList BaseContainer?", kNamed + "abstract=boolean"}},
      {"EntryList", {"any of ParameterRefEntry ArrayParameterRefEntry ArgumentRefEntry ArrayArgumentRefEntry FixedValueEntry", ""}},
      {"ParameterRefEntry", {"", "parameterRef=reference!"}},
      {"ArrayParameterRefEntry", {"", "parameterRef=reference!"}},
      {"ArgumentRefEntry", {"", "argumentRef=reference!"}},
      {"ArrayArgumentRefEntry", {"", "argumentRef=reference!"}},
      {"FixedValueEntry", {"", "name=text binaryValue=hex! sizeInBits=positive!"}},
      {"BaseContainer", {"RestrictionCriteria?", "containerRef=reference!"}},
      {"RestrictionCriteria", {"ComparisonList", ""}},
      {"ComparisonList", {"Comparison+", ""}},
      {"Comparison", {"", "parameterRef=reference! value=text!"}},
      {"MetaCommandSet", {"MetaCommand+", ""}},
      {"MetaCommand", {"BaseMetaCommand? ArgumentList? CommandContainer? DefaultSignificance?", kNamed + "abstract=boolean"}},
      {"BaseMetaCommand", {"ArgumentAssignmentList?", "metaCommandRef=reference!"}},
      {"ArgumentAssignmentList", {"ArgumentAssignment+", ""}},
      {"ArgumentAssignment", {"", "argumentName=reference! argumentValue=text!"}},
      {"ArgumentList", {"Argument+", ""}},
      {"Argument", {"", kNamed + "argumentTypeRef=reference!"}},
      {"CommandContainer", {"EntryList BaseContainer?", kNamed}},
      {"DefaultSignificance", {"", "reasonForWarning=text consequenceLevel=consequence"}},
  };
  return kRules;
}

bool has_kind(const std::string& value, const std::string& kind) {
  static const std::map<std::string, std::regex> kKinds = {
      {"none", std::regex("")},
      {"text", std::regex("[^<>]*")},
      {"name", std::regex("[^./:\\[\\] ]+")},
      {"reference", std::regex("[^./:\\[\\] ]+")},
      {"long", std::regex("-?[0-9]{1,18}")},
      {"double", std::regex("-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?")},
      {"positive", std::regex("[1-9][0-9]{0,17}")},
      {"float_size", std::regex("32|64")},
      {"boolean", std::regex("true|false")},
      {"encoding", std::regex("unsigned|twosComplement")},
      {"hex", std::regex("([0-9a-fA-F]{2})+")},
      {"consequence", std::regex("normal|vital|critical|forbidden")},
  };
  return std::regex_match(value, kKinds.at(kind));
}

struct Element {
  std::string tag, text;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
};

// Reads one element, of a text without comments; `at` is behind it then.
Element read_element(const std::string& xml, std::size_t& at) {
  const std::size_t end = xml.find('>', at);
  std::string head = xml.substr(at + 1, end - at - 1);
  const bool closed = head.back() == '/';
  if (closed) head.pop_back();
  Element element;
  element.tag = head.substr(0, head.find(' '));
  static const std::regex kAttribute("([^ =]+)=\"([^\"]*)\"");
  for (std::sregex_iterator i(head.begin(), head.end(), kAttribute), none; i != none; ++i) element.attributes[(*i)[1]] = (*i)[2];
  at = end + 1;
  while (!closed && xml.compare(at, 2, "</") != 0) {
    const std::size_t next = xml.find('<', at);
    const std::string text = xml.substr(at, next - at);
    if (text != "\n") element.text += text;
    at = next;
    if (xml[at + 1] != '/') element.children.push_back(read_element(xml, at));
  }
  if (!closed) at = xml.find('>', at) + 1;
  return element;
}

// What is wrong with it and what is in it, a line each.
class Structure {
 public:
  static std::string faults(const std::string& xml) {
    std::size_t at = xml.find("<SpaceSystem");
    const Element root = read_element(xml, at);
    Structure structure;
    structure.check(root);
    return structure.faults_;
  }

 private:
  void fault(const Element& element, const std::string& what) { faults_ += element.tag + " " + what + "\n"; }

  void check(const Element& element) {
    if (element.tag.starts_with("Integer")) bound_ = "long";
    if (element.tag.starts_with("Float")) bound_ = "double";
    const auto rule = rules().find(element.tag);
    if (rule == rules().end()) return fault(element, "is no element");
    check_attributes(element, rule->second);
    if (!has_kind(element.text, rule->second.text)) fault(element, "holds " + element.text);
    check_children(element, words(rule->second.children));
    check_names(element);
    for (const Element& child : element.children) check(child);
  }

  void check_attributes(const Element& element, const Rule& rule) {
    std::map<std::string, std::string> left = element.attributes;
    for (std::string word : words(rule.attributes)) {
      const bool needed = word.back() == '!';
      if (needed) word.pop_back();
      const std::size_t equals = word.find('=');
      const auto found = left.find(word.substr(0, equals));
      if (found == left.end()) {
        if (needed) fault(element, "lacks " + word);
        continue;
      }
      const std::string kind = word.substr(equals + 1);
      if (!has_kind(found->second, kind == "bound" ? bound_ : kind)) fault(element, word + " is " + found->second);
      left.erase(found);
    }
    for (const auto& [name, value] : left) fault(element, "has " + name);
  }

  void check_children(const Element& element, const Words& allowed) {
    const bool any = allowed.size() > 2 && allowed[0] == "any" && allowed[1] == "of";
    any ? check_set(element, allowed) : check_sequence(element, allowed);
  }

  void check_set(const Element& element, const Words& allowed) {
    const std::set<std::string> tags(allowed.begin() + 2, allowed.end());
    for (const Element& child : element.children) {
      if (!tags.contains(child.tag)) fault(element, "contains " + child.tag);
    }
  }

  void check_sequence(const Element& element, const Words& allowed) {
    std::size_t at = 0;
    for (std::string word : allowed) {
      const char mark = word.back();
      if (mark == '?' || mark == '+') word.pop_back();
      const std::size_t first = at;
      while (at < element.children.size() && element.children[at].tag == word && (at == first || mark == '+')) ++at;
      if (at == first && mark != '?') fault(element, "lacks " + word);
    }
    if (at < element.children.size()) fault(element, "has " + element.children[at].tag + " where it does not belong");
  }

  // Names are unique within each of these.
  void check_names(const Element& element) {
    static const std::set<std::string> kNameSpaces = {"ParameterTypeSet", "ArgumentTypeSet", "ParameterSet",
                                                      "ContainerSet",     "MetaCommandSet",  "ArgumentList"};
    if (!kNameSpaces.contains(element.tag)) return;
    std::set<std::string> names;
    for (const Element& child : element.children) {
      if (!names.insert(child.attributes.at("name")).second) fault(element, "has two of " + child.attributes.at("name"));
    }
  }

  std::string bound_;  // the kind of a range's bounds where we are
  std::string faults_;
};

TEST(XtceStructure, IsThatOfTheSchema) {
  VERIFIES("LASSO-GND-033~1");
  EXPECT_EQ(Structure::faults(dictionary_xtce()), "");
  EXPECT_EQ(Structure::faults(dictionary_xtce(XtceArrays::kWrittenOut)), "");
}

// What the rules are for: each of these was a mistake somebody could make.
TEST(XtceStructure, IsBrokenByMistakes) {
  VERIFIES("LASSO-GND-033~1");
  const auto with = [](const std::string& before, const std::string& after) {
    std::string xml = dictionary_xtce();
    const std::size_t at = xml.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return Structure::faults(xml.replace(at, before.size(), after));
  };
  const std::string encoding = "<IntegerDataEncoding sizeInBits=\"16\" encoding=\"unsigned\"/>";
  EXPECT_EQ(with("<UnitSet/>" + encoding, encoding + "<UnitSet/>"), "IntegerParameterType has UnitSet where it does not belong\n");
  EXPECT_EQ(with("maxInclusive=\"4294967296000000\"", "maxInclusive=\"4.294967296e+15\""),
            "ValidRange maxInclusive=bound is 4.294967296e+15\n");
  EXPECT_EQ(with("twosComplement", "twos"), "IntegerDataEncoding encoding=encoding is twos\n");
  EXPECT_EQ(with("name=\"apid_t\"", "name=\"a.pid_t\""), "IntegerParameterType name=name is a.pid_t\n");
  EXPECT_EQ(with("<Parameter name=\"service\"", "<Parameter name=\"apid\""), "ParameterSet has two of apid\n");
  EXPECT_EQ(with(" parameterTypeRef=\"apid_t\"", ""), "Parameter lacks parameterTypeRef=reference\n");
  EXPECT_EQ(with("consequenceLevel=\"critical\"", "consequenceLevel=\"high\""),
            "DefaultSignificance consequenceLevel=consequence is high\n");
  EXPECT_EQ(with("<UnitSet/>", "<Units/>"), "IntegerParameterType has Units where it does not belong\nUnits is no element\n");
}

}  // namespace
}  // namespace lasso::mdat

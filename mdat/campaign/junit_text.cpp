#include "mdat/campaign/junit_text.hpp"

#include "mdat/common/text.hpp"

namespace lasso::mdat {

std::string xml_text(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = ' ';
  }
  return escape(text);
}

std::string junit_case(const std::string& class_name, const std::string& name, const std::string& content) {
  return "    <testcase classname=\"" + xml_text(class_name) + "\" name=\"" + xml_text(name) + "\" time=\"0\"" +
         (content.empty() ? "/>\n" : ">\n" + content + "    </testcase>\n");
}

std::string junit_trouble(const char* element, const std::string& type, const std::string& message, const std::string& text) {
  return format("      <%s type=\"%s\" message=\"%s\">", element, xml_text(type).c_str(), xml_text(message).c_str()) + xml_text(text) +
         format("</%s>\n", element);
}

}  // namespace lasso::mdat

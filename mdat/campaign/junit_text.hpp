// What JUnit files are made of.
#pragma once

#include <string>

namespace lasso::mdat {

// Text as XML 1.0 can hold it: without control characters, and escaped.
std::string xml_text(std::string text);

// A test case; `content` is a failure, an error or that it was skipped, empty where it passed.
std::string junit_case(const std::string& class_name, const std::string& name, const std::string& content);

// `element` is failure or error; its message is one line.
std::string junit_trouble(const char* element, const std::string& type, const std::string& message, const std::string& text);

}  // namespace lasso::mdat

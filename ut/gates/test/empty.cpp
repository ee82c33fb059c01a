// Leaves the report of a program without a test.
#include <cstdio>
#include <cstdlib>
#include <string>
int main() {
  const std::string folder = std::string(std::getenv("GTEST_OUTPUT")).substr(4);
  std::FILE* report = std::fopen((folder + "planted.xml").c_str(), "w");
  return std::fputs("<testsuites tests=\"0\"></testsuites>", report) < 0 || std::fclose(report) != 0 ? 1 : 0;
}

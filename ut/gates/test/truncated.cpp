// Leaves a report that ends in the middle, as a crash does.
#include <cstdio>
#include <cstdlib>
#include <string>
int main() {
  const std::string folder = std::string(std::getenv("GTEST_OUTPUT")).substr(4);
  std::FILE* report = std::fopen((folder + "planted.xml").c_str(), "w");
  return std::fputs("<testsuites><testsuite>", report) < 0 || std::fclose(report) != 0 ? 1 : 0;
}

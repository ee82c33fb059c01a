// One of the two tests that run it is disabled by CMakeLists.txt.
int main() { return 0; }

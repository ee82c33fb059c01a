int main() {
  int* volatile lost = new int(7);
  lost = nullptr;
  return lost == nullptr ? 0 : 1;
}

// A program that has the component in a shared library.
int host_main(int argc, char** argv);
int main(int argc, char** argv) { return host_main(argc, argv); }

// Owner of the precompiled headers of the tests (BurinTests.cmake).
int main() {}

# Turns the library of fits into a C++ source. Run with -P and TEXT (file to read), OUTPUT (source to write).
file(READ "${TEXT}" text)
file(WRITE "${OUTPUT}.part" "#include \"core/compliance/fitted/shipped_corrections.hpp\"\n\nnamespace flankwright {\n\n"
     "const std::string_view shipped_corrections = R\"library(${text})library\";\n\n}  // namespace flankwright\n")
file(RENAME "${OUTPUT}.part" "${OUTPUT}")

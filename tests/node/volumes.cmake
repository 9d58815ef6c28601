# Brick sources, the volume writer and the survey.
burin_add_test(volume_test
  SOURCES volume_formats_test.cpp volume_orientation_test.cpp volume_error_test.cpp
          raw_name_test.cpp volume_writer_test.cpp procedural_test.cpp
          foreign_volumes_test.cpp metaimage_test.cpp ../fuzz/fed_inputs_test.cpp
  LIBRARIES burin::volumes burin_fed_inputs ZLIB::ZLIB
  LABELS node sanitize TIMEOUT 120)
target_compile_definitions(volume_test PRIVATE
  BURIN_WRITE_VOLUMES="${CMAKE_CURRENT_SOURCE_DIR}/write_volumes.py"
  BURIN_WRITE_SEEDS="${PROJECT_SOURCE_DIR}/tests/fuzz/write_seeds.py")
target_include_directories(volume_test PRIVATE ${PROJECT_SOURCE_DIR}/node/src)

burin_add_mpi_test(survey_test RANKS 1 2 3 5
  SOURCES survey_test.cpp read_slabs_test.cpp
  LIBRARIES burin::volumes ZLIB::ZLIB
  LABELS node sanitize TIMEOUT 120)
burin_add_mpi_test(real_volume_test RANKS 2
  SOURCES real_volume_test.cpp
  LIBRARIES burin::volumes ZLIB::ZLIB
  LABELS node TIMEOUT 120)

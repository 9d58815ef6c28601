# cmake -DSOURCE=… -DINSTALLED=… -P check_headers.cmake: fails unless every public header of common/
# and compositor/ was installed. What an older build has left there does not count.
foreach(folder common compositor)
  file(GLOB_RECURSE headers RELATIVE ${SOURCE}/${folder}/include ${SOURCE}/${folder}/include/*.hpp)
  if(NOT headers)
    message(FATAL_ERROR "no headers in ${SOURCE}/${folder}/include")
  endif()
  foreach(header ${headers})
    if(NOT EXISTS ${INSTALLED}/${header})
      message(FATAL_ERROR "${header} was not installed")
    endif()
  endforeach()
endforeach()

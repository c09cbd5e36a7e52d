# The page of report.html, made of web/ with Node.js and npm. Without them the program is built without it and says so.
find_program(MARKERVP_NODE NAMES node nodejs)
find_program(MARKERVP_NPM npm)
set(page_default OFF)
if(MARKERVP_NODE AND MARKERVP_NPM)
  set(page_default ON)
endif()
option(MARKERVP_PAGE "Build report.html (needs Node.js and npm, and npm's registry once)" ${page_default})
if(MARKERVP_PAGE AND NOT (MARKERVP_NODE AND MARKERVP_NPM))
  message(FATAL_ERROR "MARKERVP_PAGE needs node and npm (Debian: nodejs npm); without report.html: -DMARKERVP_PAGE=OFF")
endif()
if(NOT MARKERVP_PAGE)
  message(STATUS "report.html is left out: MARKERVP_PAGE is off (it needs node and npm; Debian: nodejs npm)")
endif()

set(MARKERVP_PAGE_FOLDER "${PROJECT_BINARY_DIR}/web")
# With the pages of the marker application, and without those of any.
set(MARKERVP_PAGE_TEMPLATE "${MARKERVP_PAGE_FOLDER}/report-template.html")
set(MARKERVP_PLAIN_PAGE_TEMPLATE "${MARKERVP_PAGE_FOLDER}/plain-template.html")
set(MARKERVP_PAGE_MODULES "${MARKERVP_PAGE_FOLDER}/node_modules")

# Defines the rule that fetches the packages. Once, before the rules of pages.
function(markervp_page_packages)
  set(web "${PROJECT_SOURCE_DIR}/web")
  set(packages "")
  if(DEFINED BUILD_TESTING AND NOT BUILD_TESTING)
    set(packages --omit=dev)
  endif()
  set(installed "${MARKERVP_PAGE_FOLDER}/installed${packages}")
  add_custom_command(OUTPUT "${installed}"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${MARKERVP_PAGE_FOLDER}"
    COMMAND "${CMAKE_COMMAND}" -E copy "${web}/package.json" "${web}/package-lock.json" "${web}/.npmrc" "${MARKERVP_PAGE_FOLDER}"
    COMMAND "${MARKERVP_NPM}" --prefix "${MARKERVP_PAGE_FOLDER}" ci --ignore-scripts --loglevel=error ${packages}
    # What is there is one of the two: the other is out of date.
    COMMAND "${CMAKE_COMMAND}" -E rm -f "${MARKERVP_PAGE_FOLDER}/installed" "${MARKERVP_PAGE_FOLDER}/installed--omit=dev"
    COMMAND "${CMAKE_COMMAND}" -E touch "${installed}"
    DEPENDS "${web}/package.json" "${web}/package-lock.json" "${web}/.npmrc"
    COMMENT "Fetching the page's packages (npm; -DMARKERVP_PAGE=OFF builds without report.html)"
    VERBATIM)
  add_custom_target(markervp_page_packages DEPENDS "${installed}")
endfunction()

# Puts the page of an application of web/src ("" for none) into the target. build.js lists the sources that it bundled in a
# dependency file, so a change of any of them makes the page again. The object with a page in an executable comes before
# that in the library of pages.
function(markervp_add_page TARGET TEMPLATE APPLICATION)
  set(web "${PROJECT_SOURCE_DIR}/web")
  add_custom_command(OUTPUT "${TEMPLATE}"
    COMMAND "${MARKERVP_NODE}" "${web}/build.js" "${TEMPLATE}" "${MARKERVP_PAGE_MODULES}" "${TEMPLATE}.d" "${APPLICATION}"
    DEPENDS markervp_page_packages "${web}/build.js"
    DEPFILE "${TEMPLATE}.d"
    COMMENT "Bundling report.html"
    VERBATIM)
  set(source "${PROJECT_SOURCE_DIR}/platform/result/page/template.S")
  target_sources(${TARGET} PRIVATE "${source}" "${TEMPLATE}")
  set_source_files_properties("${source}" PROPERTIES OBJECT_DEPENDS "${TEMPLATE}"
    COMPILE_DEFINITIONS "MARKERVP_PAGE_TEMPLATE=\"${TEMPLATE}\"")
endfunction()

# cmake -D NPM=... -D SOURCE=... -D FOLDER=... -D BUNDLE=... -P bundle_viewer.cmake
# Installs what package-lock.json names into FOLDER and writes the bundle; an empty one, with a message, where the
# registry is out of reach: the report then goes without its 3-D view.

file(GLOB files ${SOURCE}/*.js ${SOURCE}/*.json)
file(COPY ${files} DESTINATION ${FOLDER})
execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
  WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 300)
if(NOT failed)
  execute_process(COMMAND ${NPM} run --silent build -- --outfile=${BUNDLE}.part --log-level=warning
    WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 300)
endif()
if(failed)
  message(WARNING "The 3-D view of condyle report could not be bundled, so reports go without it (${failed}):\n${said}\n"
    "To try again, delete ${BUNDLE} and build.")
  file(WRITE ${BUNDLE}.part "")
endif()
file(RENAME ${BUNDLE}.part ${BUNDLE})

# Runs a command, in whose arguments paths in a folder become relative paths: FOLDER ITS_RELATIVE_PATH COMMAND...
folder=${1%/}/ relative=${2%/}/
shift 2
exec "${@/#"$folder"/"$relative"}"

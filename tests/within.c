// Runs a command of Windows where tests/windows.sh wants it: within codepage 850 COMMAND runs it in a console of that code page, and
// within held FILE COMMAND while nobody else may open the file. It ends as the command does, or from 95 on where it could not run it.
#include <wchar.h>
#include <windows.h>

static int set_code_page(UINT page) {
    return SetConsoleCP(page) && SetConsoleOutputCP(page) && GetConsoleOutputCP() == page ? 0 : 95;
}

static int hold(const wchar_t *file) {
    return CreateFileW(file, GENERIC_READ, 0, NULL, OPEN_EXISTING, 0, NULL) == INVALID_HANDLE_VALUE ? 96 : 0;
}

int wmain(int count, wchar_t **words) {
    static wchar_t line[32768];
    STARTUPINFOW how = {.cb = sizeof how};
    PROCESS_INFORMATION run;
    DWORD status = 99;
    if (count < 4) return 97;
    int failed = wcscmp(words[1], L"held") == 0 ? hold(words[2]) : set_code_page(wcstoul(words[2], NULL, 10));
    if (failed) return failed;
    for (int word = 3; word < count; word += 1) {
        if (wcslen(line) + wcslen(words[word]) + 4 > 32768) return 97;
        wcscat(wcscat(wcscat(line, L"\""), words[word]), L"\" ");
    }
    if (!CreateProcessW(NULL, line, NULL, NULL, TRUE, 0, NULL, NULL, &how, &run)) return 98;
    WaitForSingleObject(run.hProcess, INFINITE);
    GetExitCodeProcess(run.hProcess, &status);
    return status;
}

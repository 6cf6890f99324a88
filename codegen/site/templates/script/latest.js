// Written by lexibus docs.
// Leads to the newest revision. A redirection without a script would lose the address in the URL.
location.replace(document.documentElement.dataset.leads + location.hash);

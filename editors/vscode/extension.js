// What the editor starts: the language server, and a debug adapter for each session.

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function program() {
  return vscode.workspace.getConfiguration("pulsetrain").get("path");
}

exports.activate = (context) => {
  const adapter = {
    createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(program(), ["dap"]),
  };
  context.subscriptions.push(vscode.debug.registerDebugAdapterDescriptorFactory("pulsetrain", adapter));
  client = new LanguageClient(
    "pulsetrain",
    "Pulsetrain",
    { command: program(), args: ["lsp"] },
    {
      documentSelector: [{ language: "tmcl" }, { language: "ascript" }],
      synchronize: { configurationSection: "pulsetrain" },
    },
  );
  return client.start();
};

exports.deactivate = () => client?.stop();

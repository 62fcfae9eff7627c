//! The language server over a WebSocket: a text message is a message of it.

use super::{Failure, guard::query, limits::SEND_TIMEOUT, request::Answer, socket::Upgrade};
use axum::{
    extract::ws::{Message, WebSocket},
    http::Uri,
    response::Response,
};
use devices::MODELS;
use lsp::{NoFiles, Server};
use tokio::{task::spawn_blocking, time::timeout};

/// Most bytes of a message; the longest have the whole text of a program.
const MAX_MESSAGE_BYTES: usize = 4 << 20;

/// A WebSocket of the language server for programs
///
/// A text message of either side is a message of the Language Server Protocol, without its header.
#[utoipa::path(
    get, path = "/api/lsp", tag = "programs",
    params(("model" = Option<String>, Query, description = "The model that programs are for")),
    responses((status = 101))
)]
pub async fn lsp(uri: Uri, upgrade: Upgrade) -> Answer<Response> {
    let unknown = |name| Failure::unknown("model", name, MODELS.iter().map(|model| model.name));
    let model = query(&uri, "model").map(|name| devices::model(name).ok_or_else(|| unknown(name)));
    let server = Server::new(model.transpose()?, Box::new(NoFiles));
    Ok(upgrade.run(MAX_MESSAGE_BYTES, move |socket| talk(socket, server)))
}

/// Until the client leaves, one way or another.
async fn talk(mut socket: WebSocket, mut server: Server) {
    while !server.is_over() {
        let text = match socket.recv().await {
            Some(Ok(Message::Text(text))) => text,
            Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
            Some(Ok(Message::Close(_) | Message::Binary(_)) | Err(_)) | None => return,
        };
        // Compiling a long program would keep the others waiting.
        let work = spawn_blocking(move || {
            let answers = server.handle(&text);
            (server, answers)
        });
        // A panic is an assertion of the language server on its own invariants; this client loses it.
        let Ok((same, answers)) = work.await else { return };
        server = same;
        for answer in answers {
            if !matches!(timeout(SEND_TIMEOUT, socket.send(Message::text(answer))).await, Ok(Ok(()))) {
                return;
            }
        }
    }
}

//! `pulsetrain serve`

use crate::{
    Failure, Outcome,
    args::{DeviceArg, ServeArgs},
};
use server::{HttpSettings, Server, Settings, Tls, Token};
use sim::{Bench, DeviceConfig, Endpoint, Scenario, fault::scenario::no_source};
use std::{env, io::Write};

/// Where models listen when nobody said what to serve.
const USUAL_PORTS: [(&str, u16); 3] = [("pd42-1140", 4001), ("pmx-2ed", 4002), ("cmd-4cr", 4003)];

/// Sets the token of the HTTP interface.
const TOKEN_VARIABLE: &str = "PULSETRAIN_TOKEN";

/// Serves until a signal asks to end.
pub fn serve(args: ServeArgs) -> Outcome {
    let tls = args.tls_cert.zip(args.tls_key).map(|(certificate, key)| Tls { certificate, key });
    let http = if args.no_http {
        None
    } else {
        Some(HttpSettings { tls, is_insecure: args.insecure, ..HttpSettings::new(args.http, token()?) })
    };
    let mut devices = match &args.bench {
        Some(file) => Bench::read(file)?.devices,
        None => Vec::new(),
    };
    for device in args.devices {
        add(&mut devices, device)?;
    }
    if devices.is_empty() {
        devices = one_of_each();
    }
    let scenario = args.scenario.map(|file| Scenario::read(&file, &devices, &no_source));
    let scenario = scenario.transpose()?.unwrap_or_default();
    let (speed, state, record, workers) = (args.speed, args.state, args.record, args.workers);
    let server = Server::start(Settings { devices, http, speed, state, record, scenario, workers })?;
    let mut signals = server.signals()?;
    announce(&server)?;
    signals.wait();
    Ok(server.stop()?)
}

/// Who starts us waits for these lines. If standard output is closed already, nobody does.
fn announce(server: &Server) -> std::io::Result<()> {
    let mut text = String::new();
    for (name, endpoint) in server.ready() {
        text += &format!("ready {name} {endpoint}\n");
    }
    if let Some(url) = server.url() {
        text += &format!("ready http {url}\n");
    }
    let mut output = std::io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// A new device, or one more endpoint of a device that is there already.
fn add(devices: &mut Vec<DeviceConfig>, DeviceArg { model, name, endpoint }: DeviceArg) -> Outcome {
    let Some(known) = devices.iter_mut().find(|device| device.name == name) else {
        devices.push(DeviceConfig { name, listen: vec![endpoint], ..DeviceConfig::new(model) });
        return Ok(());
    };
    if known.model.name != model.name {
        let problem = format!("`{name}` is a {} already and cannot be a {}", known.model.name, model.name);
        return Err(Failure::Line(problem));
    }
    if known.listen.contains(&endpoint) && endpoint.can_be_shared() {
        return Err(Failure::Line(format!("`{name}` is at {endpoint} already")));
    }
    known.listen.push(endpoint);
    Ok(())
}

fn one_of_each() -> Vec<DeviceConfig> {
    let device = |(name, port)| {
        let endpoint = Endpoint::Tcp { host: "127.0.0.1".into(), port };
        devices::model(name).map(|model| DeviceConfig { listen: vec![endpoint], ..DeviceConfig::new(model) })
    };
    USUAL_PORTS.into_iter().filter_map(device).collect()
}

fn token() -> Result<Token, Failure> {
    match env::var(TOKEN_VARIABLE) {
        Ok(text) => Token::chosen(&text).ok_or_else(|| {
            Failure::Line(format!("{TOKEN_VARIABLE}: a token has letters, digits and `-`, `.`, `_`, `~`"))
        }),
        Err(env::VarError::NotPresent) => Ok(Token::random()?),
        Err(error) => Err(Failure::Line(format!("{TOKEN_VARIABLE}: {error}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_each_model_listens_on_its_usual_port() {
        let devices = one_of_each();
        let listed: Vec<_> =
            devices.iter().map(|device| format!("{} {}", device.name, device.listen[0])).collect();
        assert_eq!(listed[..2], ["pd42-1140 tcp:127.0.0.1:4001", "pmx-2ed tcp:127.0.0.1:4002"]);
        assert_eq!(devices.len(), devices::MODELS.len(), "each model has a usual port");
    }
}
